#include "safe/slipping_points.hpp"

namespace harmorph {

void SlippingPoints::find(SlipCurves const& slip_curves, Points now,
                          Span<const Index> representative, Span<std::uint8_t> held) noexcept {
    if (slot.empty()) return;
    curves = &slip_curves;
    fill(slot, none);
    slip_curves.for_each([&](Index place, Index point) {
        Vec2 const p = now[point], beside = p - slip_curves.nearest(place, p).at;
        Index const neighbour = slip_curves.is_last(place) ? place - 1 : place + 1;
        Real const most =
            max_distance_to_face * length(slip_curves.at[neighbour] - slip_curves.at[place]);
        if (held[point] == 0 && length(beside) <= most) slot[point] = place;
        else held[point] = 1;
    });
    for (Index k = 0; k < slot.count(); ++k) {
        Index const same = representative[k];
        if (same == k || !(slips(k) || slips(same))) continue;
        slot[k] = slot[same] = none;
        held[same] = 1;
    }
    turn_lines(now);
}

void SlippingPoints::turn_lines(Points now) const noexcept {
    for (Index k = 0; k < slot.count(); ++k) {
        if (slot[k] != none) line[k] = curves->nearest(slot[k], now[k]).tangent;
    }
}

}  // namespace harmorph
