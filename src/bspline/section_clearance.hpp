// Computes the clearance between a section and a polygon that must fit inside, and the distance
// between two bodies.
// tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

struct Clearance {
    Real value = 0;      // the smallest signed distance, positive if the polygon is inside
    CurvePlace nearest;  // the nearest place of the outline
    // If true, the nearest point lies on the straight line that closes the outline, at the fraction
    // `along` of this line.
    bool on_closing = false;
    Real along = 0;
    // The unit vector from the polygon to the outline, or the opposite vector if the polygon's
    // point is outside.
    Vec2 towards;
};

// The polygon has n >= 1 points. The smallest distance is at a corner of the polygon, or at a place
// where the outline is parallel to a side, so all these are tried.
Clearance measure_clearance(Section const& section, Points polygon, Index n) noexcept;
void pull_clearance(Section const& section, Clearance const& clearance,
                    ControlGradient const& gradient) noexcept;
// Returns the clearance of the point of the polygon that is nearest, with the smooth lower bound of
// all points as its value, and adds the derivatives to the gradient. sharpness is in 1 / length.
Clearance smooth_clearance(Section const& section, Points polygon, Index n, Real sharpness,
                           ControlGradient const& gradient) noexcept;

// Returns the point of the outline nearest to q; the value is positive if q is inside.
Clearance clearance_of_point(Section const& section, Vec2 q) noexcept;

// Computes the distance between the outlines of two bodies.

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
