// The cells of a mesh as triangles, on each of which a function is linear.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <array>
#include <vector>

namespace cli {

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
