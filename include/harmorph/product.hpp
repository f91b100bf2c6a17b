// The two products of morphing, for a few rows of function values: rows times movements, and the transpose. Every kernel
// adds in the same order and rounds alike, so that the choice of one never shows in a result.
#pragma once

#include "harmorph/processor.hpp"
#include "harmorph/vec2.hpp"

namespace harmorph {

// Numbers for the x and y of a block of functions; what is behind the last function is 0.
struct Movements {
    static constexpr Index most = 128;
    Real x[most], y[most];
};

// Rows of neighbouring points; n_functions <= Movements::most of each are used.
struct ValueRows {
    const Real* values = nullptr;
    Offset row = 0;  // numbers from one row to the next
    Index n_points = 0, n_functions = 0;
};

// sum[p] += values of point p . movements
void multiply_rows(Kernel kernel, ValueRows const& rows, Movements const& by, Vec2* sum) noexcept;
// total += sum over the points, in their order, of their values times by[p]
void multiply_rows_transposed(Kernel kernel, ValueRows const& rows, const Vec2* by, Movements& total) noexcept;

}  // namespace harmorph
