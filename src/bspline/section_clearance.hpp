// The clearance between a section and a polygon that is to fit inside.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

struct Clearance {
    Real value = 0;      // smallest signed distance, > 0 where the polygon's point is inside
    CurvePlace nearest;  // of the outline
    bool on_closing =
        false;  // the nearest point is on the straight line that closes the outline, this far along
    Real along = 0;
    Vec2 towards;  // unit vector from the polygon to the outline, of the other direction where
                   // outside
};

// n >= 1 points. The smallest distance belongs to a corner of the polygon or to a place where the
// outline is parallel to a side: these are tried.
Clearance measure_clearance(Section const& section, Points polygon, Index n) noexcept;
void pull_clearance(Section const& section, Clearance const& clearance,
                    ControlGradient const& gradient) noexcept;

}  // namespace harmorph
