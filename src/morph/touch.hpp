// The step along a displacement at which the boundary first touches itself.
#pragma once

#include "base/vec2.hpp"
#include "mesh/boundary_faces.hpp"

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
// once, so that the boundary crosses itself at s = 1, but not at s = 0, without a touch on the way,
// the step is 0. The two sides of a sliding interface may touch, as may a point and a face at whose
// end the point stays (stay_at_one_place).
// Boundary faces are those of find_crossing(); boxes of places and of displacements of list ranges
// tell when two ranges can meet, without any memory.
Touch first_touch(BoundaryFaces const& faces, Points points, Points displacement,
                  Real limit) noexcept;

}  // namespace harmorph
