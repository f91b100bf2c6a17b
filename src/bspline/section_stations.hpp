// Thickness and camber of a section on normals to its chord, and their extremes.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

enum class StationValue : std::int32_t { thickness, camber };

struct Station {
    Real at = 0;  // 0 .. 1 along the chord line
    CurvePlace top, bottom;
    Vec2 point;  // of the chord line
    Real value = 0;
};

// Needs section.find_chord().
Status measure_station(Section const& section, StationValue which, Real at, Station& station,
                       Fault& fault) noexcept;
// The largest thickness, or the camber of the largest magnitude, over all stations.
Status measure_extreme(Section const& section, StationValue which, Station& station,
                       Fault& fault) noexcept;
// Derivatives of the station's value; of an extreme they are those with the station held.
Status pull_station(Section const& section, StationValue which, Station const& station,
                    ControlGradient const& gradient, Fault& fault) noexcept;

}  // namespace harmorph
