// Area, centroid and second moments of a section by integrals along its outline (Green's theorem),
// with derivatives.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// Of the enclosed area about its centroid; xx is the integral of (y - centroid.y)^2.
struct AreaMoments {
    Real area = 0, xx = 0, yy = 0, xy = 0;
    Vec2 centroid;
};

// Derivatives of a value by the moments.
using AreaDerivative = AreaMoments;

// Also sets section.sign. Refuses outlines without area.
Status area_moments(Section& section, AreaMoments& moments, Fault& fault) noexcept;

void pull_area_moments(Section const& section, AreaMoments const& moments, AreaDerivative const& by,
                       ControlGradient const& gradient) noexcept;

}  // namespace harmorph
