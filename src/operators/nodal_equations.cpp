#include "operators/nodal_equations.hpp"

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

namespace {

constexpr Real zeros[Residual::max_width] = {};

// Sets a row to the source of the position, or to 0.
void take_source(DofValues const& dofs, Index position, Index first, Index columns,
                 Real* row) noexcept {
    const Real* const source = dofs.source_at(position);
    for (Index k = 0; k < columns; ++k) row[k] = source == nullptr ? 0 : source[first + k];
}

// The values of a basis in the rows of the scheme, beginning with column `first`.
struct BasisRows {
    NodalEquations const& equations;
    DofValues const& dofs;
    Index first;

    const Real* known(Index row) const noexcept {
        Index const slot = row - equations.n;
        return slot >= 0 && slot < equations.n_wall ? dofs.wall(slot) + first : zeros;
    }
    const Real* any(Index row) const noexcept {
        return row < equations.n ? dofs.at(row) + first : known(row);
    }
};

}  // namespace

void NodalEquations::init(Topology const& topology, Matrix const& matrix, bool corrected) noexcept {
    Span<const Index> const representative = topology.representative;
    n = matrix.n;
    n_wall = matrix.coupling_start.count() - 1;
    Span<Index> const row_of = scheme.row_of;
    Index rows = n + n_wall;
    for (Index point = 0; point < representative.count(); ++point) {
        Index const row = matrix.row_of(point);
        if (row >= 0) row_of[point] = row;
        if (Matrix::is_wall(row)) row_of[point] = n + Matrix::wall(row);
        if (row == none && representative[point] == point) row_of[point] = rows++;
    }
    for (Index point = 0; point < representative.count(); ++point)
        row_of[point] = row_of[representative[point]];
    scheme.init(topology, topology.edges, corrected);
}

void NodalEquations::set_right_hand_sides(DofValues const& dofs, Index columns) const noexcept {
    for (Index first = 0; first < columns; first += width) {
        Index const count = min(width, columns - first);
        for (Index i = 0; i < n; ++i) take_source(dofs, i, first, count, dofs.at(i) + first);
        BasisRows const rows{*this, dofs, first};
        add_balances(
            scheme, count, [&](Index row) { return row < n ? zeros : rows.known(row); }, gradient,
            [&](Index row) { return row < n ? dofs.at(row) + first : nullptr; });
    }
}

Residual::Norms NodalEquations::compute(Residual const& residual, DofValues const& dofs,
                                        Index first, Index columns) const noexcept {
    BasisRows const rows{*this, dofs, first};
    auto const balance_of = [&](Index row) {
        return row < n ? residual.value.data() + Offset{row} * residual.width : nullptr;
    };
    auto const squares = [&](Real* sums) {
        for (Index i = 0; i < n; ++i) {
            for (Index k = 0; k < columns; ++k) sums[k] += balance_of(i)[k] * balance_of(i)[k];
        }
    };
    auto const take_sources = [&] {
        fill(residual.value, 0.0);
        for (Index i = 0; i < n; ++i) take_source(dofs, i, first, columns, balance_of(i));
    };
    Residual::Norms norms;
    take_sources();
    auto const known_value = [&](Index row) { return row < n ? zeros : rows.known(row); };
    add_balances(scheme, columns, known_value, gradient, balance_of);
    squares(norms.right_hand_side);
    take_sources();
    auto const any_value = [&](Index row) { return rows.any(row); };
    add_balances(scheme, columns, any_value, gradient, balance_of);
    squares(norms.rest);
    return norms;
}

void NodalEquations::apply(const Real* from, Real* to) const noexcept {
    Span<Real> const all{to, static_cast<Size>(n) * static_cast<Size>(width)};
    fill(all, 0.0);
    add_balances(
        scheme, width, [&](Index row) { return row < n ? from + Offset{row} * width : zeros; },
        gradient, [&](Index row) { return row < n ? to + Offset{row} * width : nullptr; });
    for (Real& value : all) value = -value;
}

}  // namespace harmorph
