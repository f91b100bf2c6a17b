// Products of a symmetric matrix with a block of W functions. The W numbers of a cell stand side by
// side in the vectors. Each routine passes once over the stored triangle of the matrix, so a
// coefficient is read once for W functions. Vectors may be in single or double precision.
#pragma once

#include "base/vec2.hpp"
#include "multigrid/prolongation.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph::block {

// One number for each function.
template <Index W, class Number = Real>
struct PerFunction {
    Number at[W] = {};
    Number& operator[](Index k) noexcept { return at[k]; }
    Number operator[](Index k) const noexcept { return at[k]; }
};

template <Index W, class Number>
PerFunction<W, Number> load(const Number* from) noexcept {
    PerFunction<W, Number> out;
    for (Index k = 0; k < W; ++k) out.at[k] = from[k];
    return out;
}
template <Index W, class Number>
void store(PerFunction<W, Number> const& from, Number* to) noexcept {
    for (Index k = 0; k < W; ++k) to[k] = from.at[k];
}
// Computes to += a x.
template <Index W, class Number>
void add(Number a, const Number* x, Number* to) noexcept {
    for (Index k = 0; k < W; ++k) to[k] += a * x[k];
}

template <Index W, class Number>
void clear(Number* x, Index n) noexcept {
    std::memset(x, 0, static_cast<Size>(n) * W * sizeof(Number));
}
template <Index W, class Number>
void copy(const Number* from, Number* to, Index n) noexcept {
    std::memcpy(to, from, static_cast<Size>(n) * W * sizeof(Number));
}
// Computes to = a from, with one factor for each function.
template <Index W, class From, class To>
void convert(PerFunction<W> const& a, const From* from, To* to, Index n) noexcept {
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) to[i + k] = static_cast<To>(a.at[k] * from[i + k]);
    }
}

template <Index W, class X, class Y>
PerFunction<W> dot(const X* x, const Y* y, Index n) noexcept {
    PerFunction<W> sum;
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) sum.at[k] += Real{x[i + k]} * Real{y[i + k]};
    }
    return sum;
}

// Returns the largest absolute values, or NaN for a function that contains a NaN.
template <Index W, class Number>
PerFunction<W> largest(const Number* x, Index n) noexcept {
    PerFunction<W> out;
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k) {
            Real const size = abs(Real{x[i + k]});
            out.at[k] = exceeds(size, out.at[k]) ? size : out.at[k];
        }
    }
    return out;
}

// Computes y += a x, with one factor for each function; returns the squared norms of y.
template <Index W, class Number>
PerFunction<W> add_multiple(PerFunction<W> const& a, const Number* x, Real* y, Index n) noexcept {
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
template <Index W, class Number>
void combine(PerFunction<W> const& a, Number* x, PerFunction<W> const& b, const Number* y,
             Index n) noexcept {
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        for (Index k = 0; k < W; ++k)
            x[i + k] = static_cast<Number>(a.at[k] * x[i + k] + b.at[k] * y[i + k]);
    }
}

// Computes y += sign A x, flux by flux: row j loses what row i gains. Returns x.A x, as a sum of
// squares.
template <Index W, class Number>
PerFunction<W> add_product(SymmetricRows const& rows, Real sign, const Number* x,
                           Real* y) noexcept {
    PerFunction<W> squares;
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W> own;
        for (Index k = 0; k < W; ++k) own.at[k] = x[Offset{i} * W + k];
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
template <Index W, class Number>
PerFunction<W> multiply(SymmetricRows const& rows, const Number* x, Real* y) noexcept {
    clear<W>(y, rows.n);
    return add_product<W>(rows, 1, x, y);
}

// Computes y = A x for a Hermitian matrix with the real parts `rows`, flux by flux; returns x.y.
// The first W / 2 numbers of a cell are real parts, the others are imaginary parts.
template <Index W, class Number>
PerFunction<W> multiply(SymmetricRows const& rows, ImaginaryRows const& imaginary, const Number* x,
                        Real* y) noexcept {
    constexpr Index half = W / 2;
    clear<W>(y, rows.n);
    PerFunction<W> energies;
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W> own, sum = load<W>(y + Offset{i} * W);
        for (Index k = 0; k < W; ++k) own.at[k] = x[Offset{i} * W + k];
        Vec2 const row_sum{rows.row_sum[i], imaginary.row_sum[i]};
        for (Index k = 0; k < half; ++k) {
            Vec2 const here{own.at[k], own.at[k + half]}, flux = product(row_sum, here);
            sum.at[k] += flux.x;
            sum.at[k + half] += flux.y;
            energies.at[k] += row_sum.x * dot(here, here);
        }
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            const Number* const other = x + Offset{rows.column[e]} * W;
            Real* const to = y + Offset{rows.column[e]} * W;
            Vec2 const entry{rows.value[e], imaginary.value[e]};
            for (Index k = 0; k < half; ++k) {
                Vec2 const here{own.at[k], own.at[k + half]};
                Vec2 const rise{other[k] - here.x, other[k + half] - here.y};
                Vec2 const flux = product(entry, rise), back = product(conjugate(entry), rise);
                sum.at[k] += flux.x;
                sum.at[k + half] += flux.y;
                to[k] -= back.x;
                to[k + half] -= back.y;
                energies.at[k] -= entry.x * dot(rise, rise) + 2 * entry.y * cross(here, rise);
            }
        }
        store<W>(sum, y + Offset{i} * W);
    }
    for (Index k = 0; k < half; ++k) energies.at[k + half] = energies.at[k];
    return energies;
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
// for A = L + D + L^T, a start of 0, and a single array for the right-hand side r and the result:
//   forward:    x = (L + D)^-1 r;
//   to_defect:  defect = P^T (r - A x) = -P^T L^T x, and x = D x;
//   correct:    x -= L P (correction);
//   backward:   x = (D + L^T)^-1 x.
template <Index W, class Rows, class Number>
void forward(Rows const& rows, Number* x) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        Number* const own = x + Offset{i} * W;
        Number const inverse = static_cast<Number>(1 / rows.diagonal[i]);
        PerFunction<W, Number> value;
        for (Index k = 0; k < W; ++k) own[k] = value.at[k] = own[k] * inverse;
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(-static_cast<Number>(rows.value[e]), value.at, x + Offset{rows.column[e]} * W);
        }
    }
}

template <Index W, class Rows, class Number>
void scale_by_diagonal(Rows const& rows, Number* x) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        Number const diagonal = static_cast<Number>(rows.diagonal[i]);
        for (Index k = 0; k < W; ++k) x[Offset{i} * W + k] *= diagonal;
    }
}

template <Index W, class Rows, class Number>
void to_defect(Rows const& rows, Prolongation const& by, Index n_coarse, Number* x,
               Number* defect) noexcept {
    clear<W>(defect, n_coarse);
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W, Number> sum;
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(static_cast<Number>(rows.value[e]), x + Offset{rows.column[e]} * W, sum.at);
        }
        for (Offset e = by.start[i]; e < by.start[i + 1]; ++e) {
            add<W>(-static_cast<Number>(by.weight[e]), sum.at, defect + Offset{by.column[e]} * W);
        }
        Number const diagonal = static_cast<Number>(rows.diagonal[i]);
        for (Index k = 0; k < W; ++k)
            x[Offset{i} * W + k] *= diagonal;  // Later rows do not read this number.
    }
}

template <Index W, class Rows, class Number>
void correct(Rows const& rows, Prolongation const& by, const Number* correction,
             Number* x) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        PerFunction<W, Number> change;
        for (Offset e = by.start[i]; e < by.start[i + 1]; ++e) {
            add<W>(static_cast<Number>(by.weight[e]), correction + Offset{by.column[e]} * W,
                   change.at);
        }
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(-static_cast<Number>(rows.value[e]), change.at, x + Offset{rows.column[e]} * W);
        }
    }
}

template <Index W, class Rows, class Number>
void backward(Rows const& rows, Number* x) noexcept {
    for (Index i = rows.n - 1; i >= 0; --i) {
        PerFunction<W, Number> sum = load<W>(x + Offset{i} * W);
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            add<W>(-static_cast<Number>(rows.value[e]), x + Offset{rows.column[e]} * W, sum.at);
        }
        Number const inverse = static_cast<Number>(1 / rows.diagonal[i]);
        for (Index k = 0; k < W; ++k) x[Offset{i} * W + k] = sum.at[k] * inverse;
    }
}

}  // namespace harmorph::block
