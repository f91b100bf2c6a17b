#include "safe/mobility.hpp"

namespace harmorph {

void Mobility::lay_out(Arena& arena, Plan const& plan) noexcept {
    Index const n = plan.mesh.n_points;
    arena.take(representative, n);
    arena.take(held, n);
    arena.take(line, plan.equations.matrix.kind == MatrixKind::coupled_xy ? n : 0);
    arena.take(turn, plan.equations.matrix.turns_sides() ? n : 0);
    arena.take(sliding.slot, plan.equations.slip_curves.count > 0 ? n : 0);
}

void Mobility::find(Plan const& plan, Points now) noexcept {
    Matrix const& matrix = plan.equations.matrix;
    for (Index k = 0; k < plan.mesh.n_points; ++k) {
        Index const place = matrix.row_of[matrix.components() * k];
        bool const is_free = plan.equations.kinds[k] == PointKind::free;
        representative[k] = place < 0 ? k : plan.equations.point_of(place);
        held[k] = place < 0 || is_free ? 1 : 0;
        if (line.empty()) continue;
        line[k] =
            plan.equations.kinds[k] == PointKind::slip ? matrix.frame[representative[k]] : Vec2{};
    }
    if (!turn.empty()) copy(turn, Span<const Vec2>(matrix.frame));
    sliding.line = line;
    sliding.find(plan.equations.slip_curves, now, representative, held);
    for (Index k = 0; k < plan.mesh.n_points; ++k) held[k] = held[representative[k]];
}

}  // namespace harmorph
