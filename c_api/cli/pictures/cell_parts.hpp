// The parts of one mesh cell in the control volumes of its corners. The control volumes are those
// of the median dual, bounded by the middles of the sides and the barycentres of the cells.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <array>
#include <vector>

namespace cli {

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

}  // namespace cli
