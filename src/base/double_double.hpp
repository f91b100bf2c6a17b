// Defines numbers of twice the precision of doubles: unevaluated sums of two doubles, for
// differences and products that must be rounded once only. tests/base/test_double_double.cpp covers
// this file. (T. J. Dekker, Numer. Math. 18 (1971) 224; D. E. Knuth, The Art of Computer
// Programming 2, 4.2.2.)
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// The value is high + low, and high is the double nearest to the value. The relative error of sums,
// products and quotients is a few times 2^-104. All numbers must be below 1e290 in magnitude.
struct DoubleDouble {
    Real high = 0, low = 0;

    // Returns the exact sum, difference or product of two doubles; a product is exact unless a part
    // of it underflows.
    static constexpr DoubleDouble sum(Real a, Real b) noexcept {
        Real const s = a + b, part_of_b = s - a;
        return {s, (a - (s - part_of_b)) + (b - part_of_b)};
    }
    static constexpr DoubleDouble difference(Real a, Real b) noexcept { return sum(a, -b); }
    static constexpr DoubleDouble product(Real a, Real b) noexcept {
        Real const p = a * b, a_high = upper_half(a), a_low = a - a_high, b_high = upper_half(b),
                   b_low = b - b_high;
        return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
    }
    // Returns the double nearest to the value; 0 has no sign.
    constexpr Real rounded() const noexcept { return high + low + 0.0; }

private:
    // Returns the upper 26 bits of the mantissa.
    static constexpr Real upper_half(Real x) noexcept {
        Real const shifted = 0x1.0000002p+27 * x;  // 2^27 + 1
        return shifted - (shifted - x);
    }
};

constexpr DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.high, -a.low}; }
constexpr DoubleDouble normalised(Real large, Real small) noexcept {
    Real const sum = large + small;
    return {sum, small - (sum - large)};
}
constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
    DoubleDouble const high = DoubleDouble::sum(a.high, b.high),
                       low = DoubleDouble::sum(a.low, b.low),
                       most = normalised(high.high, high.low + low.high);
    return normalised(most.high, most.low + low.low);
}
constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + -b; }
constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
    DoubleDouble const most = DoubleDouble::product(a.high, b.high);
    return normalised(most.high, most.low + (a.high * b.low + a.low * b.high));
}
constexpr DoubleDouble operator*(Real a, DoubleDouble b) noexcept { return DoubleDouble{a, 0} * b; }
constexpr DoubleDouble operator/(DoubleDouble a, Real b) noexcept {
    Real const most = a.high / b;
    DoubleDouble const rest = a - DoubleDouble::product(most, b);
    return normalised(most, rest.high / b);
}

}  // namespace harmorph
