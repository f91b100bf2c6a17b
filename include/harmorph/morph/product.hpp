// The two products of morphing, for a few rows of function values: rows times movements, and the transpose. All kernels
// add in the same order, or in fixed point, and round alike: results do not depend on the kernel.
#pragma once

#include "harmorph/base/fixed_sum.hpp"
#include "harmorph/simd/cpu.hpp"
#include "harmorph/base/vec2.hpp"

namespace harmorph {

// Factors of a block of function values for the sums along x and y; 0 behind the last function.
struct Movements {
    static constexpr Index most = 128;
    Real x[most], y[most];
};

// Rows of consecutive points, of which n_functions <= Movements::most numbers are used. Numbers in single precision
// (float) are converted when they are loaded: products and sums are in double precision.
template <class Number>
struct ValueRows {
    const Number* values = nullptr;
    Offset row = 0;  // numbers from one row to the next
    Index n_points = 0, n_functions = 0;
};

// Of a block of points: x[p], y[p].
struct Sums {
    Real *x, *y;
};

// Sums for a block of functions in fixed point.
struct FixedSums {
    FixedSum x[Movements::most], y[Movements::most];
};

// For values of one type.
template <class Number>
struct RowProducts {
    // to[p] += values of point p . movements
    void (*multiply)(ValueRows<Number> const& rows, Movements const& by, Sums const& to) noexcept;
    // total += sum over the points of their values times by[p]; no product may reach 2^63, and n_points not 2^20.
    void (*multiply_transposed)(ValueRows<Number> const& rows, const Vec2* by, FixedSums& total) noexcept;
};

struct ProductKernels {
    RowProducts<Real> in_double;
    RowProducts<float> in_single;
    // to[i] = from[i] + sum[i], and the bits of from[i] where the sum is 0: -0.0 + 0.0 would not keep them. from may be
    // to.
    void (*add_sums)(const Real* from, Real* to, const Real* sum, Index n) noexcept;

    RowProducts<Real> const& of(ValueRows<Real> const&) const noexcept { return in_double; }
    RowProducts<float> const& of(ValueRows<float> const&) const noexcept { return in_single; }
};

ProductKernels const& product_kernels(Kernel kernel) noexcept;
// The fastest kernels for so many values; below 2^16 values CPUID costs more time than a better kernel saves.
ProductKernels const& product_kernels_for(Offset values) noexcept;

}  // namespace harmorph
