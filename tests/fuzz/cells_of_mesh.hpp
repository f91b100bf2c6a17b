// The cells of a mesh as its arrays list them, in any layout of the header except blocks.
#pragma once

#include "problem.hpp"

namespace fuzz {

// The points of each cell, counted from 0, in the order of the arrays of the caller; a triangle
// that repeats its last point has four entries.
inline std::vector<Cell> cells_of_mesh(hm_mesh const& mesh) {
    std::vector<Cell> out;
    auto const add = [&](const std::int32_t* points, std::int32_t n) {
        out.emplace_back();
        for (std::int32_t k = 0; k < n; ++k) out.back().push_back(points[k] - mesh.index_base);
    };
    if (mesh.cell_layout == HM_CELLS_STRUCTURED)
        for (std::int32_t j = 0; j + 1 < mesh.nj; ++j)
            for (std::int32_t i = 0; i + 1 < mesh.ni; ++i) {
                std::int32_t const k = i + mesh.ni * j;
                out.push_back({k, k + 1, k + 1 + mesh.ni, k + mesh.ni});
            }
    for (std::int32_t c = 0; c < mesh.n_cells; ++c) {
        std::int32_t const in_quads = c - (mesh.n_cells - mesh.n_quads);
        switch (mesh.cell_layout) {
            case HM_CELLS_TRIANGLES: add(mesh.cell_points + 3 * c, 3); break;
            case HM_CELLS_QUADS: add(mesh.cell_points + 4 * c, 4); break;
            case HM_CELLS_MIXED:
                if (in_quads < 0) add(mesh.cell_points + 3 * c, 3);
                else add(mesh.quad_points + 4 * in_quads, 4);
                break;
            case HM_CELLS_ROWS:
            case HM_CELLS_POLYGONS:
                add(mesh.cell_points + mesh.cell_start[c] - mesh.index_base,
                    mesh.cell_start[c + 1] - mesh.cell_start[c]);
                break;
            default: break;
        }
    }
    return out;
}

}  // namespace fuzz
