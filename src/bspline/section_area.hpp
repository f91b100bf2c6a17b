// Computes area, centroid and second moments of a section by integrals along the outline (Green's
// theorem), and their derivatives. tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// The second moments of the enclosed area are about the centroid; xx is the integral of (y -
// centroid.y)^2.
struct AreaMoments {
    Real area = 0, xx = 0, yy = 0, xy = 0;
    Vec2 centroid;
};

// The derivatives of a value by the moments.
using AreaDerivative = AreaMoments;

// Computes the moments and sets section.sign. Refuses outlines without area.
Status area_moments(Section& section, AreaMoments& moments, Fault& fault) noexcept;

void pull_area_moments(Section const& section, AreaMoments const& moments, AreaDerivative const& by,
                       ControlGradient const& gradient) noexcept;

}  // namespace harmorph
