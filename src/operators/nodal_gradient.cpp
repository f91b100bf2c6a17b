#include "operators/nodal_gradient.hpp"

#include "operators/nodal_balance.hpp"

namespace harmorph {

void NodalGradient::lay_out(Arena& arena, Mesh const& given_mesh, Index n_edges) noexcept {
    arena.take(row_of, given_mesh.n_points);
    arena.take(edges.start, Offset{given_mesh.n_points} + 1);
    arena.take(edges.first, n_edges);
    arena.take(edges.second, n_edges);
    arena.take(cells, given_mesh.n_cells);
    arena.take(inverse_area, given_mesh.n_points);
    dual.lay_out(arena, n_edges);
}

void NodalGradient::init(OrientedMesh const& given_mesh, Edges const& mesh_edges,
                         bool with_correction) noexcept {
    mesh = given_mesh;
    corrected = with_correction;
    copy(edges.start, Span<const Index>(mesh_edges.start));
    copy(edges.first, Span<const Edges::Side>(mesh_edges.first.first(mesh_edges.count())));
    copy(edges.second, Span<const Index>(mesh_edges.second.first(mesh_edges.count())));
    for (Index i = 0; i < cells.count(); ++i) {
        Cell const cell = mesh.cell(i);
        cells[i].row[3] = none;
        for (Index k = 0; k < cell.n; ++k) cells[i].row[k] = row_of[cell.point[k]];
    }
}

void NodalGradient::measure(Points points) noexcept {
    dual.build(mesh, edges, points);
    for (MedianDual::Face& face : dual.faces) {
        face.begin = row_of[face.begin];
        face.end = row_of[face.end];
    }
    fill(inverse_area, 0.0);
    for (Index i = 0; i < cells.count(); ++i) {
        Cell const cell = mesh.cell(i);
        Vec2 const first = points[cell.point[0]],
                   last = cell.n == 3 ? first : points[cell.point[3]];
        Vec2 const one = points[cell.point[2]] - first, other = last - points[cell.point[1]];
        cells[i].across[0] = {0.5 * one.y, -0.5 * one.x};
        cells[i].across[1] = {-0.5 * other.y, 0.5 * other.x};
        Real const area = 0.5 * cross(one, other);
        for (Index k = 0; k < cell.n; ++k) inverse_area[cells[i].row[k]] += area;
    }
    for (Real& area : inverse_area) area = area > 0 ? 1 / area : 0;
}

void NodalGradient::apply(Span<const Real> value, Index n, Span<Real> gradient,
                          Span<Real> balance) const noexcept {
    fill(balance, 0.0);
    add_balances(
        *this, n, [&](Index row) { return value.data() + Offset{row} * n; }, gradient,
        [&](Index row) { return balance.data() + Offset{row} * n; });
}

}  // namespace harmorph
