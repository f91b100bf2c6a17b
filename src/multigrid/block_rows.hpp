// Products of a symmetric matrix with a block of W functions. The W numbers of a cell stand side by
// side in the vectors. Each routine passes once over the stored triangle of the matrix, so a
// coefficient is read once for W functions.
#pragma once

#include "base/scalar.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph::block {

// One number for each function.
template <Index W>
struct PerFunction {
    Real at[W] = {};
    Real& operator[](Index k) noexcept { return at[k]; }
    Real operator[](Index k) const noexcept { return at[k]; }
};

template <Index W>
PerFunction<W> load(const Real* from) noexcept {
    PerFunction<W> out;
    for (Index k = 0; k < W; ++k) out.at[k] = from[k];
    return out;
}
template <Index W>
void store(PerFunction<W> const& from, Real* to) noexcept {
    for (Index k = 0; k < W; ++k) to[k] = from.at[k];
}
// Computes to += a x.
template <Index W>
void add(Real a, const Real* x, Real* to) noexcept {
    for (Index k = 0; k < W; ++k) to[k] += a * x[k];
}

template <Index W>
void clear(Real* x, Index n) noexcept {
    std::memset(x, 0, static_cast<Size>(n) * W * sizeof(Real));
}
template <Index W>
void copy(const Real* from, Real* to, Index n) noexcept {
    std::memcpy(to, from, static_cast<Size>(n) * W * sizeof(Real));
}

template <Index W>
PerFunction<W> dot(const Real* x, const Real* y, Index n) noexcept {
    PerFunction<W> sum;
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) sum.at[k] += x[i + k] * y[i + k];
    }
    return sum;
}

// Returns the largest absolute values, or NaN for a function that contains a NaN.
template <Index W>
PerFunction<W> largest(const Real* x, Index n) noexcept {
    PerFunction<W> out;
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) {
            Real const size = abs(x[i + k]);
            out.at[k] = exceeds(size, out.at[k]) ? size : out.at[k];
        }
    }
    return out;
}

// Computes y += a x, with one factor for each function; returns the squared norms of y.
template <Index W>
PerFunction<W> add_multiple(PerFunction<W> const& a, const Real* x, Real* y, Index n) noexcept {
    PerFunction<W> sum;
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) {
            y[i + k] += a.at[k] * x[i + k];
            sum.at[k] += y[i + k] * y[i + k];
        }
    }
    return sum;
}

// Computes x = a x + b y.
template <Index W>
void combine(PerFunction<W> const& a, Real* x, PerFunction<W> const& b, const Real* y,
             Index n) noexcept {
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) x[i + k] = a.at[k] * x[i + k] + b.at[k] * y[i + k];
    }
}

// Computes y += sign A x, flux by flux: row j loses what row i gains. Returns x.A x, as a sum of
// squares.
template <Index W>
PerFunction<W> add_product(SymmetricRows const& rows, Real sign, const Real* x, Real* y) noexcept {
    PerFunction<W> squares;
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W> const own = load<W>(x + Offset{i} * W);
        PerFunction<W> sum = load<W>(y + Offset{i} * W);
        add<W>(sign * rows.row_sum[i], own.at, sum.at);
        for (Index k = 0; k < W; ++k) squares.at[k] += rows.row_sum[i] * own.at[k] * own.at[k];
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            Offset const j = Offset{rows.column[e]} * W;
            Real const entry = sign * rows.value[e];
            for (Index k = 0; k < W; ++k) {
                Real const rise = x[j + k] - own.at[k], flux = entry * rise;
                sum.at[k] += flux;
                y[j + k] -= flux;
                squares.at[k] -= rows.value[e] * rise * rise;
            }
        }
        store<W>(sum, y + Offset{i} * W);
    }
    return squares;
}

// Computes y = A x; returns x.y.
template <Index W>
PerFunction<W> multiply(SymmetricRows const& rows, const Real* x, Real* y) noexcept {
    clear<W>(y, rows.n);
    return add_product<W>(rows, 1, x, y);
}

// Computes rest = f - A u.
template <Index W>
void residual(SymmetricRows const& rows, const Real* f, const Real* u, Real* rest) noexcept {
    copy<W>(f, rest, rows.n);
    add_product<W>(rows, -1, u, rest);
}

// Returns x.A x.
template <Index W>
PerFunction<W> energy(SymmetricRows const& rows, const Real* x) noexcept {
    PerFunction<W> sum;
    for (Index i = 0; i < rows.n; ++i) {
        const Real* const own = x + Offset{i} * W;
        for (Index k = 0; k < W; ++k) sum.at[k] += rows.row_sum[i] * own[k] * own[k];
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            const Real* const other = x + Offset{rows.column[e]} * W;
            for (Index k = 0; k < W; ++k)
                sum.at[k] -= rows.value[e] * (other[k] - own[k]) * (other[k] - own[k]);
        }
    }
    return sum;
}

// The functions below are the parts of symmetric Gauss-Seidel with a coarse correction in between,
// for A = L + D + L^T, a start of 0, and a single array:
//   x = r;
//   forward:    x = (L + D)^-1 x;
//   to_defect:  defect = sums of r - A x = -L^T x, and x = D x;
//   correct:    x -= L (correction);
//   backward:   x = (D + L^T)^-1 x.
template <Index W>
void forward(SymmetricRows const& rows, Real* x) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        Real* const own = x + Offset{i} * W;
        Real const inverse = 1 / rows.diagonal[i];
        PerFunction<W> value;
        for (Index k = 0; k < W; ++k) own[k] = value.at[k] = own[k] * inverse;
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(-rows.value[e], value.at, x + Offset{rows.column[e]} * W);
        }
    }
}

template <Index W>
void scale_by_diagonal(SymmetricRows const& rows, Real* x) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        for (Index k = 0; k < W; ++k) x[Offset{i} * W + k] *= rows.diagonal[i];
    }
}

template <Index W>
void to_defect(SymmetricRows const& rows, Span<const Index> cell_of, Index n_coarse, Real* x,
               Real* defect) noexcept {
    clear<W>(defect, n_coarse);
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W> sum;
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(rows.value[e], x + Offset{rows.column[e]} * W, sum.at);
        }
        add<W>(-1, sum.at, defect + Offset{cell_of[i]} * W);
        for (Index k = 0; k < W; ++k)
            x[Offset{i} * W + k] *= rows.diagonal[i];  // Later rows do not read this number.
    }
}

template <Index W>
void correct(SymmetricRows const& rows, Span<const Index> cell_of, const Real* correction,
             Real* x) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W> const by = load<W>(correction + Offset{cell_of[i]} * W);
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(-rows.value[e], by.at, x + Offset{rows.column[e]} * W);
        }
    }
}

template <Index W>
void backward(SymmetricRows const& rows, Real* x) noexcept {
    for (Index i = rows.n - 1; i >= 0; --i) {
        PerFunction<W> sum = load<W>(x + Offset{i} * W);
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(-rows.value[e], x + Offset{rows.column[e]} * W, sum.at);
        }
        Real const inverse = 1 / rows.diagonal[i];
        for (Index k = 0; k < W; ++k) x[Offset{i} * W + k] = sum.at[k] * inverse;
    }
}

}  // namespace harmorph::block
