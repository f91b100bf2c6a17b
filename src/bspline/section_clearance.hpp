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

}  // namespace harmorph
