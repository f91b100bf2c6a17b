// The two products of morphing, for a few numbers of the values in blocks of points
// (basis/point_blocks.hpp): values times movements, and the transpose. All kernels add in the same
// order, or in fixed point, and round alike: results do not depend on the kernel.
#pragma once

#include "base/fixed_sum.hpp"
#include "basis/point_blocks.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// Factors of some numbers of the values, for the sums along x and y.
struct Movements {
    static constexpr Index most = 128;
    Real x[most], y[most];
};

// Consecutive blocks, of which n_numbers <= Movements::most numbers are used. Numbers in single
// precision (float) are converted when they are loaded: products and sums are in double precision.
template <class Number>
struct ValueBlocks {
    const Number* values = nullptr;  // the first number used, of the first block
    Offset stride = 0;               // from one block to the next
    Index n_blocks = 0, n_numbers = 0;
};

// A number for each point of the blocks along x and along y.
template <class Number>
struct PerPoint {
    Number *x, *y;
};

// Sums for some numbers of the values in fixed point.
struct FixedSums {
    FixedSum x[Movements::most], y[Movements::most];
};

// For values of one type.
template <class Number>
struct BlockProducts {
    // sums += values . movements, for each point in the order of the numbers.
    void (*multiply)(ValueBlocks<Number> const& blocks, Movements const& by,
                     PerPoint<Real> sums) noexcept;
    // to = from + values . movements, and the bits of from where that sum is 0: -0.0 + 0.0 would
    // not keep them. from may be to, or 0 for all points: x and y null.
    void (*move)(ValueBlocks<Number> const& blocks, Movements const& by, PerPoint<const Real> from,
                 PerPoint<Real> to) noexcept;
    // total += sum over the points of their values times by, in units of the sums; no product may
    // reach 2^63, and n_blocks not exceed most_blocks.
    static constexpr Index most_blocks = 1 << 12;
    void (*multiply_transposed)(ValueBlocks<Number> const& blocks, PerPoint<const Real> by,
                                BinaryScale::Factor unit, FixedSums& total) noexcept;
};

struct ProductKernels {
    BlockProducts<Real> in_double;
    BlockProducts<float> in_single;
    // The largest of the numbers' bits without their signs; see LargestMagnitude.
    std::uint64_t (*largest_bits)(const Real* numbers, Index n) noexcept;

    BlockProducts<Real> const& of(ValueBlocks<Real> const&) const noexcept { return in_double; }
    BlockProducts<float> const& of(ValueBlocks<float> const&) const noexcept { return in_single; }
};

ProductKernels const& product_kernels(Kernel kernel) noexcept;
// The fastest kernels for so many values; `known`: the best kernel, if known. If it is not, the
// baseline is taken below worth_asking values: there CPUID, which may take ten microseconds on a
// virtual machine, costs more time than a better kernel saves.
ProductKernels const& product_kernels_for(Kernel known, Offset values,
                                          Offset worth_asking) noexcept;

}  // namespace harmorph
