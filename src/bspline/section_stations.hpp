// Computes thickness and camber of a section on normals to the chord.
// tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

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

}  // namespace harmorph
