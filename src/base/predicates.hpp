// On which side of a line and of a circle a point is: decided exactly for all finite coordinates.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// Both return a sign: -1, 0 or 1. The determinant in floating point decides where it exceeds the
// bound of its error; elsewhere the determinant is computed exactly in integers.

// 1: a, b, c run counter-clockwise; 0: they lie on one line.
int orientation_sign(Vec2 a, Vec2 b, Vec2 c) noexcept;

// 1: d is inside the circle through a, b, c, which run counter-clockwise; 0: on it.
int in_circle_sign(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept;

}  // namespace harmorph
