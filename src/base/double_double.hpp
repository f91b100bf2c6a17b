// Defines numbers of twice the precision of doubles: unevaluated sums of two doubles, for
// differences and products that must be rounded once only. tests/base/test_double_double.cpp covers
// this file. (T. J. Dekker, Numer. Math. 18 (1971) 224; D. E. Knuth, The Art of Computer
// Programming 2, 4.2.2.)
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// The value is high + low, and high is the double nearest to the value. The relative error of sums,
// products and quotients is a few times 2^-104. All numbers must be below 1e290 in magnitude.
// Number is Real, or a vector of the compiler whose lanes are values of their own.
template <class Number>
struct DoubleDoubleOf {
    Number high{}, low{};

    // Returns the exact sum, difference or product of two doubles; a product is exact unless a part
    // of it underflows.
    static constexpr DoubleDoubleOf sum(Number a, Number b) noexcept {
        Number const s = a + b, part_of_b = s - a;
        return {s, (a - (s - part_of_b)) + (b - part_of_b)};
    }
    static constexpr DoubleDoubleOf difference(Number a, Number b) noexcept { return sum(a, -b); }
    template <class Factor>
    static constexpr DoubleDoubleOf product(Factor a, Number b) noexcept {
        Factor const a_high = upper_half(a), a_low = a - a_high;
        Number const p = a * b, b_high = upper_half(b), b_low = b - b_high;
        return {p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low};
    }
    // Returns the double nearest to the value; 0 has no sign.
    constexpr Number rounded() const noexcept { return high + low + 0.0; }

private:
    // Returns the upper 26 bits of the mantissa.
    template <class Factor>
    static constexpr Factor upper_half(Factor x) noexcept {
        Factor const shifted = 0x1.0000002p+27 * x;  // 2^27 + 1
        return shifted - (shifted - x);
    }
};
using DoubleDouble = DoubleDoubleOf<Real>;

template <class Number>
constexpr DoubleDoubleOf<Number> operator-(DoubleDoubleOf<Number> a) noexcept {
    return {-a.high, -a.low};
}
template <class Number>
constexpr DoubleDoubleOf<Number> normalised(Number large, Number small) noexcept {
    Number const sum = large + small;
    return {sum, small - (sum - large)};
}
template <class Number>
constexpr DoubleDoubleOf<Number> operator+(DoubleDoubleOf<Number> a,
                                           DoubleDoubleOf<Number> b) noexcept {
    DoubleDoubleOf<Number> const high = DoubleDoubleOf<Number>::sum(a.high, b.high),
                                 low = DoubleDoubleOf<Number>::sum(a.low, b.low),
                                 leading = normalised(high.high, high.low + low.high);
    return normalised(leading.high, leading.low + low.low);
}
template <class Number>
constexpr DoubleDoubleOf<Number> operator-(DoubleDoubleOf<Number> a,
                                           DoubleDoubleOf<Number> b) noexcept {
    return a + -b;
}
template <class Number>
constexpr DoubleDoubleOf<Number> operator*(Real a, DoubleDoubleOf<Number> b) noexcept {
    DoubleDoubleOf<Number> const leading = DoubleDoubleOf<Number>::product(a, b.high);
    return normalised(leading.high, leading.low + a * b.low);
}
template <class Number>
constexpr DoubleDoubleOf<Number> doubled(DoubleDoubleOf<Number> a) noexcept {
    return {2.0 * a.high, 2.0 * a.low};
}
constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
    DoubleDouble const leading = DoubleDouble::product(a.high, b.high);
    return normalised(leading.high, leading.low + (a.high * b.low + a.low * b.high));
}
constexpr DoubleDouble operator/(DoubleDouble a, Real b) noexcept {
    Real const leading = a.high / b;
    DoubleDouble const rest = a - DoubleDouble::product(leading, b);
    return normalised(leading, rest.high / b);
}

}  // namespace harmorph
