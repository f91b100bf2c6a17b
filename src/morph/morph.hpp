// Moves mesh points: functions times movements.
#pragma once

#include "base/executor.hpp"
#include "base/fixed_sum.hpp"
#include "basis/basis.hpp"
#include "basis/point_blocks.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// The two products of morphing, for some numbers of the values in blocks of points
// (basis/point_blocks.hpp): values times movements, and the transpose. All kernels add in the same
// order, or in fixed point, and round in the same way, so results do not depend on the kernel.

// The factors of some numbers of the values, for the sums along x and y.
struct Movements {
    static constexpr Index max_count = 128;
    Real x[max_count], y[max_count];
};

// Consecutive blocks, of which n_numbers <= Movements::max_count numbers are used. Numbers in
// single precision (float) are converted when they are loaded; products and sums are in double
// precision.
template <class Number>
struct ValueBlocks {
    const Number* values = nullptr;  // The first number that is used, of the first block.
    Offset stride = 0;               // The distance from one block to the next.
    Index n_blocks = 0, n_numbers = 0;
};

// A number for each point of the blocks along x and along y.
template <class Number>
struct PerPoint {
    Number *x, *y;
};

// Sums for some numbers of the values in fixed point.
struct FixedSums {
    FixedSum x[Movements::max_count], y[Movements::max_count];
};

// Products with values of one type.
template <class Number>
struct BlockProducts {
    // Computes sums += values . movements, for each point in the order of the numbers.
    void (*multiply)(ValueBlocks<Number> const& blocks, Movements const& by,
                     PerPoint<Real> sums) noexcept;
    // Computes to = from + values . movements, and keeps the bits of `from` if that sum is 0; -0.0
    // + 0.0 would not keep them. `from` may be `to`, or 0 for all points (x and y null).
    void (*move)(ValueBlocks<Number> const& blocks, Movements const& by, PerPoint<const Real> from,
                 PerPoint<Real> to) noexcept;
    // Adds the sum over the points of their values times `by` to `total`, in units of the sums. No
    // product may reach 2^63, and n_blocks may not exceed max_blocks.
    static constexpr Index max_blocks = 1 << 12;
    void (*multiply_transposed)(ValueBlocks<Number> const& blocks, PerPoint<const Real> by,
                                BinaryScale::Factor unit, FixedSums& total) noexcept;
};

struct ProductKernels {
    BlockProducts<Real> in_double;
    BlockProducts<float> in_single;
    // Returns the largest of the numbers' bits without their signs; see LargestMagnitude.
    std::uint64_t (*largest_bits)(const Real* numbers, Index n) noexcept;

    BlockProducts<Real> const& of(ValueBlocks<Real> const&) const noexcept { return in_double; }
    BlockProducts<float> const& of(ValueBlocks<float> const&) const noexcept { return in_single; }
};

ProductKernels const& product_kernels(Kernel kernel) noexcept;
// Returns the fastest kernels for so many values; `known` is the best kernel, if known. Otherwise
// the baseline is taken below detection_threshold values, for which CPUID, which may take ten
// microseconds on a virtual machine, costs more time than a better kernel saves.
ProductKernels const& product_kernels_for(Kernel known, Offset values,
                                          Offset detection_threshold) noexcept;

// Computes to = from + sum_i F_i move_i; move [2 * functions] has x,y pairs. `from` not given means
// 0. If the sum is 0, the coordinate keeps its bits, including those of a -0.0.
void morph(Basis const& basis, const Real* move, Points from, MutablePoints to,
           Executor const& executor) noexcept;

}  // namespace harmorph
