// The two products of morphing, for a few rows of function values: rows times movements, and the transpose. Every
// kernel adds in the same order, or in fixed point, and rounds alike: the choice of one never shows in a result.
#pragma once

#include "harmorph/fixed_sum.hpp"
#include "harmorph/processor.hpp"
#include "harmorph/vec2.hpp"

namespace harmorph {

// Numbers for the x and y of a block of functions; what is behind the last function is 0.
struct Movements {
    static constexpr Index most = 128;
    Real x[most], y[most];
};

// Rows of neighbouring points; n_functions <= Movements::most of each are used. Numbers in single precision (float)
// become double ones on their way into registers: products and sums are double.
template <class Number>
struct ValueRows {
    const Number* values = nullptr;
    Offset row = 0;  // numbers from one row to the next
    Index n_points = 0, n_functions = 0;
};

// Sums for a block of functions in fixed point, see FixedSum. Unsigned, because intermediate ones wrap.
struct FixedSums {
    std::uint64_t coarse_x[Movements::most], coarse_y[Movements::most];
    std::uint64_t fine_x[Movements::most], fine_y[Movements::most];

    FixedSum x(Index k) const noexcept { return {as_signed(coarse_x[k]), as_signed(fine_x[k])}; }
    FixedSum y(Index k) const noexcept { return {as_signed(coarse_y[k]), as_signed(fine_y[k])}; }

private:
    static std::int64_t as_signed(std::uint64_t sum) noexcept { return static_cast<std::int64_t>(sum); }
};

// Few values are multiplied before the processor has told what it is.
Kernel product_kernel(Offset values) noexcept;

// sum[p] += values of point p . movements
void multiply_rows(Kernel kernel, ValueRows<Real> const& rows, Movements const& by, Vec2* sum) noexcept;
void multiply_rows(Kernel kernel, ValueRows<float> const& rows, Movements const& by, Vec2* sum) noexcept;
// total += sum over the points of their values times by[p]; no product may exceed 1.
void multiply_rows_transposed(Kernel kernel, ValueRows<Real> const& rows, const Vec2* by, FixedSums& total) noexcept;
void multiply_rows_transposed(Kernel kernel, ValueRows<float> const& rows, const Vec2* by, FixedSums& total) noexcept;

}  // namespace harmorph
