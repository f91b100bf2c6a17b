// Decides exactly, for all finite coordinates, on which side of a line or circle a point lies.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// Both functions return a sign: -1, 0 or 1. If the determinant in floating point exceeds the bound
// of the rounding error, its sign is exact; otherwise the determinant is computed in integers.

// Returns 1 if a, b, c run counter-clockwise, 0 if they lie on one line, and -1 otherwise.
int orientation_sign(Vec2 a, Vec2 b, Vec2 c) noexcept;

// Returns 1 if d is inside the circle through a, b, c, 0 if d is on it, and -1 if d is outside; a,
// b, c must run counter-clockwise.
int in_circle_sign(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept;

}  // namespace harmorph
