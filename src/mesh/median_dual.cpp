#include "harmorph/mesh/median_dual.hpp"

#include "harmorph/mesh/cell_shape.hpp"

namespace harmorph {
namespace {

Vec2 barycentre(CellShape const& shape) noexcept {
    Vec2 sum = shape.at[0] + shape.at[1] + shape.at[2];
    if (shape.n == 4) sum = sum + shape.at[3];
    return (shape.n == 4 ? 0.25 : 1.0 / 3) * sum;
}

constexpr Vec2 turned_right(Vec2 a) noexcept { return {a.y, -a.x}; }

}  // namespace

void MedianDual::lay_out(Arena& arena, Index n_edges, Index n_points) noexcept {
    arena.take(faces, n_edges);
    arena.take(area, n_points);
}

void MedianDual::build(Mesh const& mesh, Points points, Edges const& edges, Span<const Index> representative,
                       Span<const std::uint8_t> reversed) const noexcept {
    edges.for_each([&](Index edge, Index low, Index high) {
        Vec2 const middle = 0.5 * (points[low] + points[high]);
        Vec2 normal;
        auto const add = [&](Index code) {
            Index const cell = cell_of_side(code);
            Vec2 const from_middle = barycentre(CellShape(mesh.cell(cell), points, false)) - middle;
            bool const on_left = runs_backwards(code) == (reversed[cell] != 0);
            normal = on_left ? normal + turned_right(from_middle) : normal - turned_right(from_middle);
        };
        add(edges.first[edge].code);
        if (!edges.is_boundary(edge)) add(edges.second[edge]);
        faces[edge] = {low, high, normal, points[high] - points[low]};
    });
    fill(area, 0.0);
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell cell = mesh.cell(i);
        if (reversed[i] != 0) cell.reverse();
        CellShape const shape(cell, points, false);
        Vec2 const centre = barycentre(shape);
        for (Index k = 0; k < cell.n; ++k) {  // the quad of corner, midpoint, barycentre, midpoint
            Vec2 const next = points[cell.next(k)], previous = points[cell.previous(k)];
            area[representative[cell.point[k]]] += 0.5 * cross(centre - shape.at[k], 0.5 * (previous - next));
        }
    }
}

}  // namespace harmorph
