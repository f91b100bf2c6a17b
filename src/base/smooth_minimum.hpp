// The smooth lower bound of the smallest of many values, by Kreisselmeier and Steinhauser. With the
// smallest value m,
//
//     bound = m - ln(sum_k exp(-sharpness (v_k - m))) / sharpness,
//     d(bound) = sum_k w_k dv_k,   w_k = exp(-sharpness (v_k - m)) / (the sum).
//
// The sum is computed before m is known, with a shift s in place of m; the result then is
// s - ln(sum) / sharpness. tests/morph/test_cell_bounds.cpp covers this file.
#pragma once

#include "base/elementary.hpp"
#include "base/exponential_series.hpp"

namespace harmorph {

struct SmoothMinimum {
    Real sharpness = 0, shift = 0;
    Real smallest = infinity;  // the smallest value so far
    Index item = none;         // the first item with this value
    Real sum = 0;              // the sum of the weights exp(sharpness (shift - v_k))
    std::int64_t count = 0;

    // Returns the weight by the formula of the kernels (morph/bound_kernel).
    Real weight(Real value) const noexcept {
        constexpr Real max_exponent = 600, grid = 0x1.8p52, per_log_2 = 1.4426950408889634;
        Real const exponent = min(sharpness * (shift - value), max_exponent);
        if (!(exponent > -max_exponent)) return 0;
        Real const shifted = exponent * per_log_2 + grid, n = shifted - grid;
        Real series;
        exponential_series((exponent - n * log_2_high) - n * log_2_low, series);
        std::uint64_t const bits = bits_of(series) + (bits_of(shifted) << 52);
        std::memcpy(&series, &bits, sizeof series);
        return series;
    }
    void note(Real value, Index number) noexcept {
        if (value < smallest || (value == smallest && number < item)) {
            smallest = value;
            item = number;
        }
    }
    // Adds a value and returns its weight.
    Real add(Real value, Index number) noexcept {
        Real const of_value = weight(value);
        note(value, number);
        sum += of_value;
        ++count;
        return of_value;
    }
    // Merges the values of items that come later.
    void merge(SmoothMinimum const& later) noexcept {
        note(later.smallest, later.item);
        sum += later.sum;
        count += later.count;
    }
    // Tells whether the shift is so close to the smallest value that neither the weights nor their
    // products with derivatives overflow or underflow.
    bool is_accurate() const noexcept { return abs(sharpness * (smallest - shift)) <= 300; }
    Real bound() const noexcept {
        // Rounding must not lift the bound above the smallest value.
        return min(smallest, shift - logarithm(sum) / sharpness);
    }
};

}  // namespace harmorph
