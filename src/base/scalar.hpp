// The few functions of numbers that the core needs; <cmath> would bring errno and a mathematics
// library.
#pragma once

#include <cstring>

#include "base/types.hpp"

namespace harmorph {

inline constexpr Real infinity = __builtin_huge_val();
inline constexpr Real epsilon = 2.220446049250313e-16;  // 2^-52: spacing of doubles at 1

// -fno-math-errno makes this one instruction wherever the processor has it.
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

// Larger than the largest so far? NaN counts as larger than all numbers, so that a NaN once found
// is kept.
constexpr bool exceeds(Real found, Real largest) noexcept {
    return !(found <= largest) && largest == largest;
}

inline std::uint64_t bits_of(Real x) noexcept {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Neither infinite nor NaN. By the bits: a comparison with NaN would raise an exception, which
// callers may trap.
inline bool is_finite(Real x) noexcept {
    constexpr std::uint64_t exponent = 0x7FF0000000000000u;
    return (bits_of(x) & exponent) != exponent;
}

// The largest power of two that is not larger than a positive normal number.
inline Real power_of_two_at(Real x) noexcept {
    std::uint64_t const exponent = bits_of(x) & 0x7FF0000000000000u;
    Real power;
    std::memcpy(&power, &exponent, sizeof power);
    return power;
}

}  // namespace harmorph
