#include "safe/mobility.hpp"

namespace harmorph {

void Mobility::lay_out(Arena& arena, Plan const& plan) noexcept {
    Index const n = plan.mesh().n_points;
    arena.take(representative, n);
    arena.take(held, n);
    arena.take(line, plan.unknowns().couples_xy() ? n : 0);
    arena.take(turn, plan.unknowns().turns_sides() ? n : 0);
    arena.take(slipping.slot, plan.equations().slip_curves().count > 0 ? n : 0);
}

void Mobility::find(Plan const& plan, Points now) noexcept {
    for (Index k = 0; k < plan.mesh().n_points; ++k) {
        bool const is_free = plan.kind(k) == PointKind::free;
        representative[k] = plan.representative(k);
        held[k] = !plan.unknowns().is_unknown(k) || is_free ? 1 : 0;
        if (!line.empty())
            line[k] = plan.kind(k) == PointKind::slip ? plan.unknowns().direction(representative[k])
                                                      : Vec2{};
        if (!turn.empty()) turn[k] = plan.unknowns().turn(k);
    }
    slipping.line = line;
    slipping.find(plan.equations().slip_curves(), now, representative, held);
    for (Index k = 0; k < plan.mesh().n_points; ++k) held[k] = held[representative[k]];
}

}  // namespace harmorph
