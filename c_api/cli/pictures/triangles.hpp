// The cells of a mesh as triangles, on each of which a function is linear.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <array>
#include <vector>

namespace cli {

// The parts of one mesh cell in the control volumes of its corners. The control volumes are those
// of the median dual, bounded by the middles of the sides and the barycentres of the cells.

struct CellParts {
    std::vector<std::int32_t> points;   // places of the corners in the mesh
    std::vector<Point> corner, middle;  // middle[i] lies between corner i and the next one
    Point barycentre = {0, 0};
    Box box;

    CellParts(const Mesh& mesh, std::size_t cell) {
        for (std::int32_t i = mesh.cell_start[cell]; i < mesh.cell_start[cell + 1]; ++i) {
            points.push_back(mesh.cell_points[static_cast<std::size_t>(i)]);
            const auto point = static_cast<std::size_t>(points.back());
            corner.push_back({mesh.x[point], mesh.y[point]});
            box.include(corner.back());
        }
        const auto n = static_cast<double>(corner.size());
        for (std::size_t i = 0; i < corner.size(); ++i) {
            const Point here = corner[i], next = corner[(i + 1) % corner.size()];
            middle.push_back({(here.x + next.x) / 2, (here.y + next.y) / 2});
            barycentre.x += here.x / n;
            barycentre.y += here.y / n;
        }
    }
    std::size_t size() const { return corner.size(); }
    // Returns the part in the control volume of corner i.
    std::array<Point, 4> part(std::size_t i) const {
        return {middle[(i + size() - 1) % size()], corner[i], middle[i], barycentre};
    }
};

using Corners = std::array<std::int32_t, 3>;  // places of the points in the mesh

// Adds the triangles of a cell that need not be convex, by cutting off its ears (G. H. Meisters,
// Polygons have ears, The American Mathematical Monthly 82, 1975).
void divide_polygon(const Mesh& mesh, std::size_t cell, std::vector<Corners>& triangles);

// Calls visit(corners) for each triangle that lies at least partly in the window. A quadrilateral
// has two triangles, and a polygon as many as it needs.
template <class Visit>
void for_each_triangle(const Mesh& mesh, const Box& window, Visit visit) {
    std::vector<Corners> triangles;
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const std::int32_t* const points =
            &mesh.cell_points[static_cast<std::size_t>(mesh.cell_start[cell])];
        const auto n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
        triangles.clear();
        if (n > 4) {
            divide_polygon(mesh, cell, triangles);
        } else {
            for (std::int32_t i = 1; i + 1 < n; ++i)
                triangles.push_back({points[0], points[i], points[i + 1]});
        }
        for (const Corners& corners : triangles) {
            Box box;
            for (const std::int32_t corner : corners) {
                box.include(Point{mesh.x[static_cast<std::size_t>(corner)],
                                  mesh.y[static_cast<std::size_t>(corner)]});
            }
            if (box.overlaps(window)) visit(corners);
        }
    }
}

}  // namespace cli
