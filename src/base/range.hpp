// Checks that numbers of the caller are finite and in range. Their bits are tested before they are
// compared: a comparison with NaN would raise a floating-point exception, which callers may trap.
// tests/base/test_scalar.cpp covers this file.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// All three functions return false for NaN.
inline bool is_at_most(Real x, Real size) noexcept { return is_finite(x) && abs(x) <= size; }
inline bool is_between(Real low, Real x, Real high) noexcept {
    return is_finite(x) && low <= x && x <= high;
}
inline bool is_coordinate(Vec2 p) noexcept {
    return is_finite(p.x) && is_finite(p.y) && is_in_range(p);
}

}  // namespace harmorph
