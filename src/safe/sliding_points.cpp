#include "safe/sliding_points.hpp"

namespace harmorph {

void SlidingPoints::find(SlipCurves const& its, Points now, Span<const Index> representative,
                         Span<std::uint8_t> held) noexcept {
    if (slot.empty()) return;
    curves = &its;
    fill(slot, none);
    its.for_each([&](Index its_slot, Index point) {
        Vec2 const p = now[point], beside = p - its.nearest(its_slot, p).at;
        Index const neighbour = its.is_last(its_slot) ? its_slot - 1 : its_slot + 1;
        Real const most = most_beside * length(its.at[neighbour] - its.at[its_slot]);
        if (held[point] == 0 && length(beside) <= most) slot[point] = its_slot;
        else held[point] = 1;
    });
    for (Index k = 0; k < slot.count(); ++k) {
        Index const same = representative[k];
        if (same == k || !(slides(k) || slides(same))) continue;
        slot[k] = slot[same] = none;
        held[same] = 1;
    }
    turn_lines(now);
}

void SlidingPoints::turn_lines(Points now) const noexcept {
    for (Index k = 0; k < slot.count(); ++k) {
        if (slot[k] != none) line[k] = curves->nearest(slot[k], now[k]).tangent;
    }
}

}  // namespace harmorph
