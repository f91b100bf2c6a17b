#include "harmorph/residual.hpp"

namespace harmorph {
namespace {

// Real arithmetic for one plane of numbers, complex for two: the second plane follows `plane` numbers after the first.
template <Index planes>
struct Columns {
    Index n, width;  // of them; room for as many

    // row -= (re + i im) x
    void subtract(Real re, Real im, const Real* x, Offset plane, Real* row) const noexcept {
        for (Index k = 0; k < n; ++k) {
            row[k] -= re * x[k];
            if constexpr (planes == 2) {
                row[k] += im * x[plane + k];
                row[width + k] -= re * x[plane + k] + im * x[k];
            }
        }
    }

    void add_squares(Span<const Real> rows, Real* sums) const noexcept {
        for (const Real* row = rows.begin(); row != rows.end(); row += width) {
            for (Index k = 0; k < n; ++k) sums[k] += row[k] * row[k];
        }
    }
};

template <Index planes>
Residual::Norms compute_planes(Matrix const& matrix, Lines const& lines, Index first, Index n, Index width,
                               Span<Real> value) noexcept {
    Columns<planes> const columns{n, width};
    Offset const plane = lines.columns(matrix);
    auto const row_of = [&](Index position) { return value.data() + Offset{position} * planes * width; };
    Residual::Norms norms;
    fill(value, 0.0);
    for (Index wall = 0; wall + 1 < matrix.coupling_start.count(); ++wall) {
        const Real* const known = lines.wall(wall) + first;
        for (Index c = matrix.coupling_start[wall]; c < matrix.coupling_start[wall + 1]; ++c) {
            Real const imaginary = planes == 2 ? matrix.coupling_imaginary[c] : 0;
            columns.subtract(matrix.coupling_value[c], imaginary, known, plane, row_of(matrix.coupling_row[c]));
        }
    }
    columns.add_squares(value, norms.right_hand_side);
    for (Index i = 0; i < matrix.n; ++i) {
        const Real* const own = lines.at(i) + first;
        Real* const row = row_of(i);
        columns.subtract(matrix.diagonal[i], 0, own, plane, row);
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            Index const j = matrix.column[e];
            Real const imaginary = planes == 2 ? matrix.imaginary[e] : 0;
            columns.subtract(matrix.value[e], imaginary, lines.at(j) + first, plane, row);
            columns.subtract(matrix.value[e], -imaginary, own, plane, row_of(j));
        }
    }
    columns.add_squares(value, norms.rest);
    return norms;
}

}  // namespace

Real Residual::Norms::relative(Index k) const noexcept {
    return square_root(rest[k]) / (right_hand_side[k] > 0 ? square_root(right_hand_side[k]) : 1);
}

Residual::Norms Residual::compute(Matrix const& matrix, Lines const& lines, Index first, Index n) const noexcept {
    return matrix.is_complex() ? compute_planes<2>(matrix, lines, first, n, width, value)
                               : compute_planes<1>(matrix, lines, first, n, width, value);
}

void Residual::add_to(Matrix const& matrix, Lines const& lines, Index first, Index n, Choice const& chosen) const noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Offset const plane = lines.columns(matrix);
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p) {
            Real* const to = lines.at(i) + p * plane + first;
            const Real* const from = value.data() + (Offset{i} * planes + p) * width;
            for (Index k = 0; k < n; ++k) to[k] = chosen.column[k] ? to[k] + from[k] : to[k];
        }
    }
}

}  // namespace harmorph
