// Computes logarithms, exponentials, powers and sines from series, because <cmath> would need a
// mathematics library at link time. Relative errors are a few units in the last place. The smooth
// minimum of many numbers is built on exponentials.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// Returns the natural logarithm of a normal number x > 0. With x = 2^e m and sqrt(1/2) <= m <
// sqrt(2), log m = 2 artanh((m - 1) / (m + 1)).
inline Real logarithm(Real x) noexcept {
    constexpr Real log_2 = 0.6931471805599453;
    Real power = power_of_two_at(x);
    Real m = x / power;
    if (m > 1.4142135623730951) {
        m *= 0.5;
        power *= 2;
    }
    Index const e = static_cast<Index>(bits_of(power) >> 52) - 1023;
    Real const t = (m - 1) / (m + 1), s = t * t;  // s < 0.0295
    Real sum = 0;
    for (Index k = 21; k >= 1; k -= 2) sum = sum * s + 1.0 / k;
    return static_cast<Real>(e) * log_2 + 2 * t * sum;
}

// Returns e^x for x <= 700; the result is 0 below x = -700.
inline Real exponential(Real x) noexcept {
    // The sum of both numbers is log 2 to more digits than one number holds.
    constexpr Real high = 0.693147180369123816490, low = 1.90821492927058770002e-10;
    if (x < -700) return 0;
    Real const n = static_cast<Real>(static_cast<Index>(x / (high + low) + (x < 0 ? -0.5 : 0.5)));
    Real const r = (x - n * high) - n * low;  // |r| <= 0.35
    Real sum = 1;
    for (Index k = 14; k >= 1; --k) sum = 1 + r / k * sum;
    std::uint64_t const bits = static_cast<std::uint64_t>(static_cast<Index>(n) + 1023) << 52;
    Real power;
    std::memcpy(&power, &bits, sizeof power);
    return sum * power;
}

// Returns x^y for x >= 0; 0^0 is 1.
inline Real power(Real x, Real y) noexcept {
    if (y == 0 || x == 1) return 1;
    if (!(x >= 1e-300)) return 0;
    return exponential(clamp(y * logarithm(x), -701.0, 700.0));
}

// Returns sin(pi x) for 0 <= x <= 1.
inline Real sine_of_pi(Real x) noexcept {
    Real const t = 3.141592653589793 * (x > 0.5 ? 1 - x : x), s = t * t;
    Real sum = 1;
    for (Index k = 20; k >= 2; k -= 2) sum = 1 - s / static_cast<Real>(k * (k + 1)) * sum;
    return t * sum;
}

// The series of the exponential function, for one number and for several at a time.

// The sum of both numbers is log 2 to more digits than one number holds.
inline constexpr double log_2_high = 0.693147180369123816490,
                        log_2_low = 1.90821492927058770002e-10;

// Returns e^r for |r| <= 0.35, with a relative error of a few units in the last place. Number is a
// Real, or a vector of them, so the result is a reference.
template <class Number>
__attribute__((always_inline)) inline void exponential_series(Number const& r,
                                                              Number& result) noexcept {
    Number const s = r * r;
    Number const even =
        1 + s * (1.0 / 2 + s * (1.0 / 24 +
                                s * (1.0 / 720 + s * (1.0 / 40320 + s * (1.0 / 3628800 +
                                                                         s * (1.0 / 479001600))))));
    Number const odd =
        1 + s * (1.0 / 6 +
                 s * (1.0 / 120 +
                      s * (1.0 / 5040 +
                           s * (1.0 / 362880 + s * (1.0 / 39916800 + s * (1.0 / 6227020800))))));
    result = even + r * odd;
}

// The smooth lower bound of the smallest of many values, by Kreisselmeier and Steinhauser. With the
// smallest value m,
//
//     bound = m - ln(sum_k exp(-sharpness (v_k - m))) / sharpness,
//     d(bound) = sum_k w_k dv_k,   w_k = exp(-sharpness (v_k - m)) / (the sum).
//
// The sum is computed before m is known, with a shift s in place of m; the result then is s -
// ln(sum) / sharpness.
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
