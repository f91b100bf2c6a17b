#include "mesh/control_volumes.hpp"

namespace harmorph {

void ControlVolumes::lay_out(Arena& arena, Index n) noexcept {
    arena.take(area, n);
    arena.take(shortest_edge, n);
}

void ControlVolumes::measure(OrientedMesh const& cells, Points points,
                             Span<const Index> unknown_of) noexcept {
    fill(area, 0.0);
    fill(shortest_edge, infinity);
    for (Index i = 0; i < cells.mesh.n_cells; ++i) {
        Cell const cell = cells.cell(i);
        Vec2 const origin = points[cell.point[0]];
        Vec2 at[4], sum;
        for (Index k = 0; k < cell.n; ++k) {
            at[k] = points[cell.point[k]] - origin;
            sum = sum + at[k];
        }
        Vec2 const barycentre = (1.0 / cell.n) * sum;
        for (Index k = 0; k < cell.n; ++k) {
            Index const unknown = unknown_of[cell.point[k]];
            if (unknown < 0) continue;
            Vec2 const ahead = 0.5 * (at[k + 1 == cell.n ? 0 : k + 1] - at[k]);
            Vec2 const behind = 0.5 * (at[k == 0 ? cell.n - 1 : k - 1] - at[k]);
            Vec2 const middle = barycentre - at[k];
            area[unknown] += 0.5 * (cross(ahead, middle) + cross(middle, behind));
            shortest_edge[unknown] =
                min(shortest_edge[unknown], 2 * min(length(ahead), length(behind)));
        }
    }
}

}  // namespace harmorph
