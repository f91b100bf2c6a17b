#include "safe/mobility.hpp"

namespace harmorph {

void SlippingPoints::find(SlipCurves const& slip_curves, Points now,
                          Span<const Index> representative, Span<std::uint8_t> held) noexcept {
    if (slot.empty()) return;
    curves = &slip_curves;
    fill(slot, none);
    slip_curves.for_each([&](Index place, Index point) {
        Vec2 const p = now[point], beside = p - slip_curves.nearest(place, p).at;
        Index const neighbour = slip_curves.is_last(place) ? place - 1 : place + 1;
        Real const max_distance =
            max_distance_to_face * length(slip_curves.at[neighbour] - slip_curves.at[place]);
        if (held[point] == 0 && length(beside) <= max_distance) slot[point] = place;
        else held[point] = 1;
    });
    for (Index k = 0; k < slot.count(); ++k) {
        Index const same = representative[k];
        if (same == k || !(slips(k) || slips(same))) continue;
        slot[k] = slot[same] = none;
        held[same] = 1;
    }
    rotate_lines(now);
}

void SlippingPoints::rotate_lines(Points now) const noexcept {
    for (Index k = 0; k < slot.count(); ++k) {
        if (slot[k] != none) line[k] = curves->nearest(slot[k], now[k]).tangent;
    }
}

void Mobility::lay_out(Arena& arena, Plan const& plan) noexcept {
    Index const n = plan.mesh().n_points;
    arena.take(representative, n);
    arena.take(held, n);
    arena.take(line, plan.unknowns().couples_xy() ? n : 0);
    arena.take(rotation, plan.unknowns().has_rotated_sides() ? n : 0);
    arena.take(slipping.slot, plan.equations().slip_curves().count > 0 ? n : 0);
}

void Mobility::find(Plan const& plan, Points now) noexcept {
    for (Index k = 0; k < plan.mesh().n_points; ++k) {
        bool const is_free = plan.equations().kind(k) == PointKind::free;
        representative[k] = plan.representative(k);
        held[k] = !plan.unknowns().is_unknown(k) || is_free ? 1 : 0;
        if (!line.empty())
            line[k] = plan.equations().kind(k) == PointKind::slip
                          ? plan.unknowns().direction(representative[k])
                          : Vec2{};
        if (!rotation.empty()) rotation[k] = plan.unknowns().rotation(k);
    }
    slipping.line = line;
    slipping.find(plan.equations().slip_curves(), now, representative, held);
    for (Index k = 0; k < plan.mesh().n_points; ++k) held[k] = held[representative[k]];
}

}  // namespace harmorph
