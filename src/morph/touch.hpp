// The step along a displacement at which the boundary first touches itself.
#pragma once

#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

struct Touch {
    Real step = infinity;
    Index point = none;            // The point that touches a face.
    Index face[2] = {none, none};  // The points where this face begins and ends.
};

// Returns the smallest s with 0 < s < limit at which a point of the boundary lies on a face to
// which it does not belong, with all points at points + s displacement. The first touch of two
// faces is one of an end of the one with the other, so no other pairs are examined. The area
// between a point and a face is a quadratic function of s, whose roots are exact except for
// rounding. Faces that touch at s = 0 count when they touch again. If they cross each other at
// once, so that the boundary at s = 1 crosses itself without a touch on the way, the step is 0.
// Boundary faces are those of find_crossing(); boxes of places and of displacements of list ranges
// tell when two ranges can meet, without any memory.
Touch first_touch(Span<const Index> boundary_point, Span<const Index> loop_start, Points points,
                  Points displacement, Real limit) noexcept;

}  // namespace harmorph
