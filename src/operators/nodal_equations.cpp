#include "operators/nodal_equations.hpp"

#include "operators/nodal_balance.hpp"

namespace harmorph {
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
