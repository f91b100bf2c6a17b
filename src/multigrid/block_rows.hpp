// Products of a symmetric matrix with a block of W functions. The W numbers of a cell stand side by
// side in the vectors. Each routine passes once over the stored triangle of the matrix, so a
// coefficient is read once for W functions. Vectors may be in single or double precision.
#pragma once

#include "base/scalar.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph::block {

// The W numbers of a cell in registers of 16 bytes, which all processors with vectors have.
template <Index W, class Number>
struct Lanes {
    static constexpr Index lanes = 16 / sizeof(Number), parts = W / lanes;
    using Part [[gnu::vector_size(16)]] = Number;
    using Stored [[gnu::vector_size(16), gnu::aligned(sizeof(Number)), gnu::may_alias]] = Number;

    Part part[parts];

    Lanes() noexcept {
        for (Index p = 0; p < parts; ++p) part[p] = Part{};
    }
    explicit Lanes(const Number* from) noexcept {
        for (Index p = 0; p < parts; ++p)
            part[p] = *reinterpret_cast<const Stored*>(from + p * lanes);
    }
    template <class Other>
    explicit Lanes(const Other* from) noexcept {
        for (Index p = 0; p < parts; ++p) {
            for (Index k = 0; k < lanes; ++k) part[p][k] = static_cast<Number>(from[p * lanes + k]);
        }
    }
    void store(Number* to) const noexcept {
        for (Index p = 0; p < parts; ++p) *reinterpret_cast<Stored*>(to + p * lanes) = part[p];
    }
    Lanes& operator+=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] += other.part[p];
        return *this;
    }
    Lanes& operator-=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] -= other.part[p];
        return *this;
    }
    Lanes& operator*=(Lanes const& other) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] *= other.part[p];
        return *this;
    }
    Lanes& operator*=(Number factor) noexcept {
        for (Index p = 0; p < parts; ++p) part[p] *= factor;
        return *this;
    }
    friend Lanes operator*(Number factor, Lanes x) noexcept { return x *= factor; }
    friend Lanes operator*(Lanes x, Lanes const& y) noexcept { return x *= y; }
};

// One number for each function.
template <Index W, class Number = Real>
struct PerFunction {
    Number at[W] = {};
    PerFunction() noexcept = default;
    explicit PerFunction(Lanes<W, Number> const& lanes) noexcept { lanes.store(at); }
    Number& operator[](Index k) noexcept { return at[k]; }
    Number operator[](Index k) const noexcept { return at[k]; }
};

// Computes to += a x.
template <Index W, class Number>
void add(Number a, Lanes<W, Number> const& x, Number* to) noexcept {
    Lanes<W, Number> sum(to);
    sum += a * x;
    sum.store(to);
}
template <Index W, class Number>
void add(Number a, const Number* x, Number* to) noexcept {
    add(a, Lanes<W, Number>(x), to);
}

template <Index W, class Number>
void clear(Number* x, Index n) noexcept {
    std::memset(x, 0, static_cast<Size>(n) * W * sizeof(Number));
}
template <Index W, class Number>
void copy(const Number* from, Number* to, Index n) noexcept {
    std::memcpy(to, from, static_cast<Size>(n) * W * sizeof(Number));
}

template <Index W, class X, class Y>
PerFunction<W> dot(const X* x, const Y* y, Index n) noexcept {
    Lanes<W, Real> sum;
    for (Offset i = 0; i < Offset{n} * W; i += W)
        sum += Lanes<W, Real>(x + i) * Lanes<W, Real>(y + i);
    return PerFunction<W>(sum);
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
    Lanes<W, Real> const factor(a.at);
    Lanes<W, Real> sum;
    for (Offset i = 0; i < Offset{n} * W; i += W) {
        Lanes<W, Real> value(y + i);
        value += factor * Lanes<W, Real>(x + i);
        value.store(y + i);
        sum += value * value;
    }
    return PerFunction<W>(sum);
}

// Computes y += sign A x, flux by flux: row j loses what row i gains. Returns x.A x, as a sum of
// squares.
template <Index W, class Number>
PerFunction<W> add_product(SymmetricRows const& rows, Real sign, const Number* x,
                           Real* y) noexcept {
    using Numbers = Lanes<W, Real>;
    Numbers squares;
    for (Index i = 0; i < rows.n; ++i) {
        Numbers const own(x + Offset{i} * W);
        Numbers sum(y + Offset{i} * W);
        sum += (sign * rows.row_sum[i]) * own;
        squares += rows.row_sum[i] * own * own;
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            Offset const j = Offset{rows.column[e]} * W;
            Numbers rise(x + j), other(y + j);
            rise -= own;
            Numbers const flux = (sign * rows.value[e]) * rise;
            sum += flux;
            other -= flux;
            other.store(y + j);
            squares -= rows.value[e] * rise * rise;
        }
        sum.store(y + Offset{i} * W);
    }
    return PerFunction<W>(squares);
}

// Computes y = A x; returns x.y.
template <Index W, class Number>
PerFunction<W> multiply(SymmetricRows const& rows, const Number* x, Real* y) noexcept {
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

}  // namespace harmorph::block
