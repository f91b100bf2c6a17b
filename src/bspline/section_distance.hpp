// Computes the distance between the outlines of two bodies.
// tests/bspline/test_section_distance.cpp covers this file.
#pragma once

#include "bspline/section_clearance.hpp"

namespace harmorph {

// The smallest distance of a place on one outline from the other outline, with a negative sign if
// the place is inside the other body.
struct BodyDistance {
    Real value = infinity;
    bool place_is_on_other = false;  // on which of the two outlines `place` lies
    CurvePlace place;
    Clearance nearest;  // the point of the other outline that is nearest to `place`
};

// Both sections must be connected. Outlines are tried from both sides, so that a body inside the
// other one has a negative distance, whichever it is.
BodyDistance body_distance(Section const& section, Section const& other) noexcept;
// Adds `weight` times the derivatives by the control points of both bodies.
void pull_body_distance(Section const& section, Section const& other, BodyDistance const& distance,
                        Real weight, ControlGradient const& gradient) noexcept;
// Returns the smallest distance of places in all spans of knots, with the smooth lower bound of all
// these distances as its value. Adds the derivatives to the gradient. sharpness is in 1 / length.
BodyDistance smooth_body_distance(Section const& section, Section const& other, Real sharpness,
                                  ControlGradient const& gradient) noexcept;

}  // namespace harmorph
