// Defines the few functions of numbers that the core needs, because <cmath> would need errno and a
// mathematics library.
#pragma once

#include <cstring>

#include "base/types.hpp"

namespace harmorph {

inline constexpr Real infinity = __builtin_huge_val();
inline constexpr Real epsilon = 2.220446049250313e-16;  // 2^-52, the spacing of doubles at 1

// The option -fno-math-errno makes this one instruction, if the processor has one.
inline Real sqrt(Real x) noexcept { return __builtin_sqrt(x); }

constexpr Real abs(Real x) noexcept { return x < 0 ? -x : x; }
template <class T>
constexpr T min(T a, T b) noexcept {
    return b < a ? b : a;
}
template <class T>
constexpr T max(T a, T b) noexcept {
    return a < b ? b : a;
}
template <class T>
constexpr T clamp(T x, T low, T high) noexcept {
    return x < low ? low : high < x ? high : x;
}

// Returns whether `found` is larger than the largest number so far. NaN counts as larger than all
// numbers, so that a NaN is kept once it is found.
constexpr bool exceeds(Real found, Real largest) noexcept {
    return !(found <= largest) && largest == largest;
}

inline std::uint64_t bits_of(Real x) noexcept {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Returns whether x is neither infinite nor NaN. The bits decide, because a comparison with NaN
// would raise a floating-point exception, which callers may trap.
inline bool is_finite(Real x) noexcept {
    constexpr std::uint64_t exponent = 0x7FF0000000000000u;
    return (bits_of(x) & exponent) != exponent;
}

// Returns the largest power of two that is not larger than x, a positive number; 0 if x is
// denormal.
inline Real power_of_two_at(Real x) noexcept {
    std::uint64_t const exponent = bits_of(x) & 0x7FF0000000000000u;
    Real power;
    std::memcpy(&power, &exponent, sizeof power);
    return power;
}

}  // namespace harmorph
