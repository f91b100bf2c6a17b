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

// The largest thickness, or the camber of the largest magnitude, over all stations.
//
// The derivative of an extreme is that of the value at a held station where the value is smooth
// along the chord. Where the outline has a corner at the extreme, the value has one slope before
// the station and another one behind it, and the derivatives with the station held differ as well.
// With weights that add up to 1 and make the weighted sum of the two slopes 0, the weighted sum of
// the two derivatives is the derivative of the extreme, which moves with the corner: for the
// station s(P) of the corner and the value t(s, P) on either side, dt/dP = (dt/dP at s) + (dt/ds)
// ds/dP is the same on both sides, and ds/dP cancels.
struct ExtremeStation {
    Station before, behind;  // the same one twice, where the extreme is at the first or last
                             // station that is tried
    Real weight_before = 1;
};

// Needs section.find_chord().
Status measure_station(Section const& section, StationValue which, Real at, Station& station,
                       Fault& fault) noexcept;
Status measure_extreme(Section const& section, StationValue which, ExtremeStation& extreme,
                       Fault& fault) noexcept;
// `weight` times the derivatives of the value with the station held.
Status pull_station(Section const& section, StationValue which, Station const& station, Real weight,
                    ControlGradient const& gradient, Fault& fault) noexcept;
Status pull_extreme(Section const& section, StationValue which, ExtremeStation const& extreme,
                    ControlGradient const& gradient, Fault& fault) noexcept;

}  // namespace harmorph
