#include "harmorph/residual.hpp"

namespace harmorph {
namespace {

void add_squares(Span<const Real> rows, Real* sums) noexcept {
    for (Size i = 0; i < rows.size(); i += Residual::width) {
        for (Index k = 0; k < Residual::width; ++k) sums[k] += rows[i + static_cast<Size>(k)] * rows[i + static_cast<Size>(k)];
    }
}

}  // namespace

Real Residual::Norms::relative(Index k) const noexcept {
    return square_root(rest[k]) / (right_hand_side[k] > 0 ? square_root(right_hand_side[k]) : 1);
}

Residual::Norms Residual::compute(Matrix const& matrix, Basis const& basis, Span<const Index> point_of, Index first,
                                  Index n) const noexcept {
    auto const row_of = [&](Index position) { return value.data() + Offset{position} * width; };
    Norms norms;
    fill(value, 0.0);
    for (Index slot = 0; slot < basis.wall_point.count(); ++slot) {
        const Real* const known = basis.row(basis.wall_point[slot]) + first;
        for (Index c = matrix.coupling_start[slot]; c < matrix.coupling_start[slot + 1]; ++c) {
            Real* const row = row_of(matrix.coupling_row[c]);
            for (Index k = 0; k < n; ++k) row[k] -= matrix.coupling_value[c] * known[k];
        }
    }
    add_squares(value, norms.right_hand_side);
    for (Index i = 0; i < matrix.n; ++i) {
        const Real* const own = basis.row(point_of[i]) + first;
        Real* const row = row_of(i);
        for (Index k = 0; k < n; ++k) row[k] -= matrix.diagonal[i] * own[k];
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            Index const j = matrix.column[e];
            const Real* const other = basis.row(point_of[j]) + first;
            Real* const other_row = row_of(j);
            for (Index k = 0; k < n; ++k) row[k] -= matrix.value[e] * other[k];
            for (Index k = 0; k < n; ++k) other_row[k] -= matrix.value[e] * own[k];
        }
    }
    add_squares(value, norms.rest);
    return norms;
}

void Residual::add_to(Basis const& basis, Span<const Index> point_of, Index first, Index n) const noexcept {
    for (Index i = 0; i < point_of.count(); ++i) {
        Real* const row = basis.row(point_of[i]) + first;
        for (Index k = 0; k < n; ++k) row[k] += value[Offset{i} * width + k];
    }
}

}  // namespace harmorph
