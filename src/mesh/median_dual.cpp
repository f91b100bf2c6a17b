#include "mesh/median_dual.hpp"

#include "mesh/cell_shape.hpp"

namespace harmorph {
namespace {

Vec2 barycentre(CellShape const& shape) noexcept {
    Vec2 sum = shape.at[0] + shape.at[1] + shape.at[2];
    if (shape.n == 4) sum = sum + shape.at[3];
    return (shape.n == 4 ? 0.25 : 1.0 / 3) * sum;
}

constexpr Vec2 rotated_right(Vec2 a) noexcept { return {a.y, -a.x}; }

}  // namespace

void MedianDual::build(OrientedMesh const& cells, Edges const& edges,
                       Points points) const noexcept {
    edges.for_each([&](Index edge, Index low, Index high) {
        Vec2 const middle = 0.5 * (points[low] + points[high]);
        Vec2 normal;
        auto const add = [&](Index code) {
            Index const cell = cell_of_side(code);
            Vec2 const from_middle =
                barycentre(CellShape(cells.mesh.cell(cell), points, false)) - middle;
            bool const on_left = runs_backwards(code) == (cells.reversed[cell] != 0);
            normal =
                on_left ? normal + rotated_right(from_middle) : normal - rotated_right(from_middle);
        };
        add(edges.first[edge].code);
        if (!edges.is_boundary(edge)) add(edges.second[edge]);
        faces[edge] = {low, high, normal, points[high] - points[low]};
    });
}

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
