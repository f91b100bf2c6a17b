// The cells of a mesh as triangles, and what a function that is linear on each of them has where.
#pragma once

#include "geometry.hpp"
#include "mesh.hpp"

#include <array>

namespace cli {

using Corners = std::array<std::int32_t, 3>; // points of the mesh

// visit(corners) for each triangle that the window shows at least a part of: a triangular cell, or the two of a quad.
template <class Visit> void for_each_triangle(const Mesh& mesh, const Box& window, Visit visit) {
    for (std::size_t cell = 0; cell + 1 < mesh.cell_start.size(); ++cell) {
        const auto first = static_cast<std::size_t>(mesh.cell_start[cell]);
        const auto end = static_cast<std::size_t>(mesh.cell_start[cell + 1]);
        for (std::size_t i = first + 1; i + 1 < end; ++i) {
            const Corners corners = {mesh.cell_points[first], mesh.cell_points[i], mesh.cell_points[i + 1]};
            Box box;
            for (const std::int32_t corner : corners) {
                box.include(Point{mesh.x[static_cast<std::size_t>(corner)], mesh.y[static_cast<std::size_t>(corner)]});
            }
            if (box.overlaps(window)) visit(corners);
        }
    }
}

} // namespace cli
