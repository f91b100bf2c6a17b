// Curvature of a section: at the leading edge, its largest value, its variation; with derivatives.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// Radius of curvature at the leading edge, > 0 where convex. Needs area_moments (the orientation)
// and find_chord(true).
Status nose_radius(Section const& section, Real& radius, ControlGradient const& gradient,
                   Fault& fault) noexcept;

struct Bend {
    CurvePlace place;
    Real radius = 0;
};
// The smallest radius of curvature of the curves, > 0; corners do not count.
Status smallest_radius(Section const& section, Bend& bend, ControlGradient const& gradient,
                       Fault& fault) noexcept;

// The integral of (d curvature / d arc length)^2 over the arc length: the minimum variation
// functional of H. Moreton and C. Sequin, Comput. Graph. 26 (1992) 167.
Status curvature_variation(Section const& section, Real& variation, ControlGradient const& gradient,
                           Fault& fault) noexcept;

}  // namespace harmorph
