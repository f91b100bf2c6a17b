// Finds the extremes of thickness and camber over the stations of a section.
// tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// Computes thickness and camber of a section on normals to the chord.
enum class StationValue : std::int32_t { thickness, camber };

struct Station {
    Real at = 0;  // 0 .. 1 along the chord line
    CurvePlace top, bottom;
    Vec2 point;  // on the chord line
    Real value = 0;
};

// section.find_chord() must have been called.
Status measure_station(Section const& section, StationValue which, Real at, Station& station,
                       Fault& fault) noexcept;
// Does the same without a fault: minus infinity if the normal meets the outline at fewer than two
// points.
Real station_value(Section const& section, StationValue which, Real at, Station& station) noexcept;
// Returns the derivative of the value along the chord, per length of the chord.
Real station_slope(Section const& section, StationValue which, Station const& station) noexcept;
// Adds `weight` times the derivatives of the value at a fixed station.
Status pull_station(Section const& section, StationValue which, Station const& station, Real weight,
                    ControlGradient const& gradient, Fault& fault) noexcept;

// Returns true only if the component of a span of a curve along a direction is monotone. The
// differences of the control points show this, except for rational curves, for which the result is
// false.
bool runs_one_way(Curve const& curve, Index span, Vec2 along) noexcept;

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
