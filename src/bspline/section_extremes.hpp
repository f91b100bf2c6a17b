// Finds the extremes of thickness and camber over the stations of a section.
// tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/section_stations.hpp"

namespace harmorph {

// The extreme is the largest thickness, or the camber of the largest magnitude, over all stations.
//
// If the value is smooth along the chord, the derivative of the extreme is the derivative at a
// fixed station. If the outline has a corner at the extreme, the value has one slope before the
// station and another slope after it, and the derivatives at the fixed station differ, too. Choose
// two weights that add up to 1 and for which the weighted sum of the slopes is 0. The weighted sum
// of the two derivatives then is the derivative of the extreme, which moves with the corner: for
// the station s(P) of the corner and the value t(s, P) on either side, dt/dP = (dt/dP at s) +
// (dt/ds) ds/dP is equal on both sides, and ds/dP cancels in the sum.
struct ExtremeStation {
    // Both stations are equal if the extreme is at the first or last station that is tried.
    Station before, behind;
    Real weight_before = 1;
};

// section.find_chord() must have been called.
Status measure_extreme(Section const& section, StationValue which, ExtremeStation& extreme,
                       Fault& fault) noexcept;
// Finds the smallest thickness over the stations from first to last.
Status measure_thinnest(Section const& section, Real first, Real last, ExtremeStation& extreme,
                        Fault& fault) noexcept;
// Computes the smooth lower bound of the thickness at equidistant stations from first to last, adds
// its derivatives to the gradient, and sets the station of the smallest one. sharpness is in
// 1 / length.
Status measure_smooth_thinnest(Section const& section, Real first, Real last, Real sharpness,
                               Station& thinnest, Real& bound, ControlGradient const& gradient,
                               Fault& fault) noexcept;
Status pull_extreme(Section const& section, StationValue which, ExtremeStation const& extreme,
                    ControlGradient const& gradient, Fault& fault) noexcept;

}  // namespace harmorph
