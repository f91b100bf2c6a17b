#include "harmorph/residual.hpp"

#include "kernel_call.hpp"

namespace harmorph {

#define HARMORPH_DECLARE(kernel)                                                                              \
    namespace kernel {                                                                                        \
    void add_inner_flows(Matrix const& matrix, Lines const& lines, Index first, Index n, Real* value, Index width,\
                         Real* squares) noexcept;                                                             \
    }
HARMORPH_FOR_EACH_KERNEL(HARMORPH_DECLARE)

namespace {

// value += what flows between unknowns; squares: of the rows then.
void add_inner_flows(Kernel kernel, Matrix const& matrix, Lines const& lines, Index first, Index n, Real* value,
                     Index width, Real* squares) noexcept {
    HARMORPH_CALL(kernel, add_inner_flows(matrix, lines, first, n, value, width, squares))
}

// Real arithmetic for one plane of numbers, complex for two: the second plane follows `plane` numbers after the first.
template <Index planes>
struct Columns {
    Index n, width;  // of them; room for as many
    Offset plane;

    // row -= (re + i im) x
    void subtract(Real re, Real im, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n; ++k) {
            row[k] -= re * x[k];
            if constexpr (planes == 2) {
                row[k] += im * x[plane + k];
                row[width + k] -= re * x[plane + k] + im * x[k];
            }
        }
    }
    // What flows from x to own along a coupling: row -= (re + i im) (x - own)
    void take_flow(Real re, Real im, const Real* own, const Real* x, Real* row) const noexcept {
        for (Index k = 0; k < n; ++k) {
            Real const rise = x[k] - own[k];
            row[k] -= re * rise;
            if constexpr (planes == 2) {
                Real const turned = x[plane + k] - own[plane + k];
                row[k] += im * turned;
                row[width + k] -= re * turned + im * rise;
            }
        }
    }

    void add_squares(const Real* row, Real* sums) const noexcept {
        for (Index p = 0; p < planes; ++p) {
            for (Index k = 0; k < n; ++k) sums[k] += row[p * width + k] * row[p * width + k];
        }
    }
};

template <Index planes>
class Balances {
public:
    Balances(Matrix const& matrix, Lines const& lines, Index first, Index n, Index width, Span<Real> value,
             Kernel kernel) noexcept
        : matrix_(matrix), lines_(lines), first_(first), columns_{n, width, lines.columns(matrix)}, value_(value),
          kernel_(kernel) {}

    Residual::Norms run() const noexcept {
        Residual::Norms norms;
        fill(value_, 0.0);
        take_right_hand_sides(norms.right_hand_side);
        if (matrix_.kind == MatrixKind::two_lines) {
            add_products(norms.rest);
        } else {
            add_flows(norms.rest);
        }
        return norms;
    }

private:
    Real* row_of(Index position) const noexcept {
        return value_.data() + Offset{position} * planes * columns_.width;
    }
    const Real* at(Index position) const noexcept { return lines_.at(position) + first_; }
    Real imaginary(Span<Real> of, Offset entry) const noexcept { return planes == 2 ? of[entry] : 0; }

    // visit(coupling, unknown, known values)
    template <class Visit>
    void for_each_coupling(Visit visit) const noexcept {
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = lines_.wall(wall) + first_;
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1]; ++c) {
                visit(c, matrix_.coupling_row[c], known);
            }
        }
    }

    // Their squares; the rows are 0 again.
    void take_right_hand_sides(Real* squares) const noexcept {
        for_each_coupling([&](Index c, Index i, const Real* known) {
            columns_.subtract(matrix_.coupling_value[c], imaginary(matrix_.coupling_imaginary, c), known, row_of(i));
        });
        for (Index const i : matrix_.coupling_row) {
            columns_.add_squares(row_of(i), squares);
            fill(Span<Real>(row_of(i), static_cast<Size>(planes * columns_.width)), 0.0);
        }
    }

    void add_flows(Real* squares) const noexcept {
        for_each_coupling([&](Index c, Index i, const Real* known) {
            Real const turned = imaginary(matrix_.coupling_imaginary, c);
            columns_.take_flow(matrix_.coupling_value[c], turned, at(i), known, row_of(i));
        });
        for (Index h = 0; h < matrix_.held_row.count(); ++h) {
            Index const i = matrix_.held_row[h];
            columns_.subtract(-matrix_.held_value[h], -imaginary(matrix_.held_imaginary, h), at(i), row_of(i));
        }
        add_inner_flows(kernel_, matrix_, lines_, first_, columns_.n, value_.data(), columns_.width, squares);
    }

    void add_products(Real* squares) const noexcept {
        for_each_coupling([&](Index c, Index i, const Real* known) {
            columns_.subtract(matrix_.coupling_value[c], 0, known, row_of(i));
        });
        for (Index i = 0; i < matrix_.n; ++i) {
            columns_.subtract(matrix_.diagonal[i], 0, at(i), row_of(i));
            for (Offset e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e) {
                Index const j = matrix_.column[e];
                columns_.subtract(matrix_.value[e], 0, at(j), row_of(i));
                columns_.subtract(matrix_.value[e], 0, at(i), row_of(j));
            }
            columns_.add_squares(row_of(i), squares);
        }
    }

    Matrix const& matrix_;
    Lines const& lines_;
    Index first_;
    Columns<planes> columns_;
    Span<Real> value_;
    Kernel kernel_;
};

}  // namespace

Real Residual::Norms::relative(Index k) const noexcept {
    return square_root(rest[k]) / (right_hand_side[k] > 0 ? square_root(right_hand_side[k]) : 1);
}

Residual::Norms Residual::compute(Matrix const& matrix, Lines const& lines, Index first, Index n) const noexcept {
    return matrix.is_complex() ? Balances<2>(matrix, lines, first, n, width, value, kernel).run()
                               : Balances<1>(matrix, lines, first, n, width, value, kernel).run();
}

Residual::Changes Residual::add_to(Matrix const& matrix, Lines const& lines, Index first, Index n,
                                   Choice const& chosen) const noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Offset const plane = lines.columns(matrix);
    Real change[widest] = {}, size[widest] = {};
    for (Index i = 0; i < matrix.n; ++i) {
        for (Index p = 0; p < planes; ++p) {
            Real* const to = lines.at(i) + p * plane + first;
            const Real* const from = value.data() + (Offset{i} * planes + p) * width;
            for (Index k = 0; k < n; ++k) {
                to[k] = chosen.column[k] ? to[k] + from[k] : to[k];
                change[k] = larger(change[k], absolute(from[k]));
                size[k] = larger(size[k], absolute(to[k]));
            }
        }
    }
    Changes out;
    for (Index k = 0; k < n; ++k) out.column[k] = size[k] > 0 ? change[k] / size[k] : 0;
    return out;
}

void Residual::set_constant(Matrix const& matrix) const noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Span<Real> const b = value.first(matrix.n * planes);
    auto const subtract = [&](Span<const Index> rows, Span<const Real> re, Span<const Real> im) {
        for (Index c = 0; c < rows.count(); ++c) {
            b[planes * rows[c]] -= re[c];
            if (planes == 2) b[planes * rows[c] + 1] -= im[c];
        }
    };
    fill(b, 0.0);
    subtract(matrix.coupling_row, matrix.coupling_value, matrix.coupling_imaginary);
    subtract(matrix.held_row, matrix.held_value, matrix.held_imaginary);
}

Real Residual::off_constant(Matrix const& matrix) const noexcept {
    Index const planes = matrix.is_complex() ? 2 : 1;
    Real most = 0;
    for (Index i = 0; i < planes * matrix.n; ++i) {
        Real const off = absolute(value[i] - (i % planes == 0 ? 1 : 0));
        if (!(off <= most)) most = off;  // NaN stays
    }
    return most;
}

}  // namespace harmorph
