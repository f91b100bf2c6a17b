// How far the boundary can go along a displacement before it first touches itself.
#pragma once

#include "base/vec2.hpp"
#include "mesh/boundary_faces.hpp"

namespace harmorph {

struct Touch {
    Real step = infinity;
    Index point = none;            // the point that touches a face
    Index face[2] = {none, none};  // the points where this face begins and ends
};

// Smallest s with 0 < s < limit at which a point of the boundary lies on a face that it does not
// belong to, all points at points + s displacement. The first touch of two faces is one of an end
// of the one with the other, so no other pairs are looked at; the area between a point and a face
// is a quadratic function of s, whose roots are exact but for rounding. Faces that touch at s = 0
// count where they touch again; if they cross each other at once, so that the boundary at s = 1
// crosses itself, and did not at s = 0, without a touch on the way, the step is 0. Boundary faces
// as in find_crossing; boxes of places and of displacements of list ranges say when two ranges can
// meet, without any memory. The two sides of a sliding interface may touch.
Touch first_touch(BoundaryFaces const& faces, Points points, Points displacement,
                  Real limit) noexcept;

}  // namespace harmorph
