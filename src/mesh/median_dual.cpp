#include "mesh/median_dual.hpp"

#include "mesh/cell_shape.hpp"

namespace harmorph {
namespace {

Vec2 barycentre(CellShape const& shape) noexcept {
    Vec2 sum = shape.at[0] + shape.at[1] + shape.at[2];
    if (shape.n == 4) sum = sum + shape.at[3];
    return (shape.n == 4 ? 0.25 : 1.0 / 3) * sum;
}

constexpr Vec2 turned_right(Vec2 a) noexcept { return {a.y, -a.x}; }

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
                on_left ? normal + turned_right(from_middle) : normal - turned_right(from_middle);
        };
        add(edges.first[edge].code);
        if (!edges.is_boundary(edge)) add(edges.second[edge]);
        faces[edge] = {low, high, normal, points[high] - points[low]};
    });
}

}  // namespace harmorph
