// Computes measures of the curvature of a section and their derivatives: the radius at the leading
// edge, the smallest radius, and the variation. tests/bspline/test_section_measures.cpp covers this
// file.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// Computes the radius of curvature at the leading edge, which is positive if the outline is convex
// there. area_moments() and section.find_chord(true) must have been called.
Status radius_at_leading_edge(Section const& section, Real& radius, ControlGradient const& gradient,
                              Fault& fault) noexcept;

struct SmallestRadius {
    CurvePlace place;
    Real radius = 0;
};
// Computes the smallest radius of curvature of the curves, which is positive; corners do not count.
Status smallest_radius(Section const& section, SmallestRadius& bend,
                       ControlGradient const& gradient, Fault& fault) noexcept;

// Computes the integral of (d curvature / d arc length)^2 over the arc length: the minimum
// variation functional of H. Moreton and C. Sequin, Comput. Graph. 26 (1992) 167.
Status curvature_variation(Section const& section, Real& variation, ControlGradient const& gradient,
                           Fault& fault) noexcept;

}  // namespace harmorph
