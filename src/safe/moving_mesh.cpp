#include "safe/moving_mesh.hpp"

#include "morph/morph.hpp"

namespace harmorph {

void MovingMesh::lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept {
    path.lay_out(arena, counts);
    carried.lay_out(arena, counts);
    Offset const n_numbers = 2 * Offset{counts.functions()};
    arena.take(x, counts.points);
    arena.take(y, counts.points);
    arena.take(ahead_x, counts.points);
    arena.take(ahead_y, counts.points);
    arena.take(reached, n_numbers);
    arena.take(aimed, n_numbers);
    arena.take(difference, n_numbers);
    arena.take(ends, counts.points);
    arena.take(representative, counts.points);
    arena.take(held, counts.points);
    arena.take(slip_place, plan.equations().slip_curves().n_slots());
}

void MovingMesh::init(Plan const& plan, Basis const& basis, const Real* move) noexcept {
    path.init(basis, move);
    carried.init(basis, path, plan.mesh().points);
    for (Index k = 0; k < plan.mesh().n_points; ++k) {
        bool const is_unknown = plan.unknowns().is_unknown(k);
        ends[k] = !is_unknown                ? KnownEnd::prescribed
                  : plan.unknowns().slips(k) ? KnownEnd::on_line
                                             : KnownEnd::unknown;
        held[k] = is_unknown ? 0 : 1;
        representative[k] = plan.representative(k);
    }
    for (Index const point : basis.boundary_point) {
        held[point] = 1;
        representative[point] = point;
    }
    begin(plan);
}

void MovingMesh::begin(Plan const& plan) noexcept {
    for (Index k = 0; k < plan.mesh().n_points; ++k) {
        x[k] = plan.mesh().points[k].x;
        y[k] = plan.mesh().points[k].y;
    }
    fill(reached, 0.0);
    time = 0;
    carried.forget();
}

AdmissibleStep MovingMesh::look_ahead(Plan& plan, Basis const& basis, Basis const& by,
                                      Real to) noexcept {
    Executor const& executor = plan.executor();
    aimed_time = to;
    path.at(to, aimed);
    for (Index i = 0; i < difference.count(); ++i) difference[i] = aimed[i] - reached[i];
    morph(by, difference.data(), {}, to_ahead(), executor);
    carried.find_groups(basis, path, plan.mesh().points, plan.walls(), representative, held,
                        executor);
    carried.find(by, reached, now(), representative, executor);
    carried.add(path, time, to, to_ahead(), executor);
    if (carried.reach > 0)
        for_wall(plan, basis, [&](Index k, Vec2 start, Vec2 moved) {
            to_ahead().set(k, start + moved - now()[k]);
        });
    put_on_slip_curves(plan);
    AdmissibleStep const limit = admissible_step(plan.cells(), now(), ahead(), executor);
    for (Index k = 0; k < x.count(); ++k) {
        ahead_x[k] = ahead_x[k] == 0 ? x[k] : x[k] + ahead_x[k];
        ahead_y[k] = ahead_y[k] == 0 ? y[k] : y[k] + ahead_y[k];
    }
    for_wall(plan, basis, [&](Index k, Vec2 start, Vec2 moved) {
        to_ahead().set(k, {moved.x == 0 ? start.x : start.x + moved.x,
                           moved.y == 0 ? start.y : start.y + moved.y});
    });
    return limit;
}

// Replaces displacements along tangents by displacements to the nearest places of the curves; the
// other points follow.
void MovingMesh::put_on_slip_curves(Plan const& plan) noexcept {
    SlipCurves const& curves = plan.equations().slip_curves();
    if (curves.count == 0) return;
    curves.for_each([&](Index slot, Index point) {
        slip_place[slot] = curves.nearest(slot, now()[point] + ahead()[point]);
    });
    plan.equations().slip_followers().for_each(curves, [&](Index k, Index slot, Real part) {
        Index const point = curves.point[slot];
        Vec2 const back = slip_place[slot].at - (now()[point] + ahead()[point]);
        if (back.x != 0 || back.y != 0) to_ahead().set(k, ahead()[k] + part * back);
    });
    curves.for_each([&](Index slot, Index point) {
        Vec2 const by = ahead()[point];
        if (by.x != 0 || by.y != 0) to_ahead().set(point, slip_place[slot].at - now()[point]);
    });
    for (Index k = 0; k < x.count(); ++k) {  // the displacements keep their bits
        if (plan.unknowns().slips(k)) to_ahead().set(k, ahead()[plan.representative(k)]);
    }
}

void MovingMesh::advance() noexcept {
    copy(x, Span<const Real>(ahead_x));
    copy(y, Span<const Real>(ahead_y));
    copy(reached, Span<const Real>(aimed));
    time = aimed_time;
    carried.forget();
}

Vec2 MovingMesh::wall_move(Plan const& plan, Basis const& basis, Index slot,
                           TurnAt& turn) const noexcept {
    if (basis.is_given(slot) && !given.empty() && aimed_time >= 1)
        return given[slot - plan.given().first_slot];
    return basis.wall_move(slot, aimed.data()) + carried.of_wall(basis, path, slot, turn);
}

template <class Visit>
void MovingMesh::for_wall(Plan const& plan, Basis const& basis, Visit const& visit) const noexcept {
    TurnAt turn(path, aimed_time);
    for (Index k = 0; k < plan.mesh().n_points; ++k) {
        Index const slot = plan.unknowns().wall_slot(k);
        if (slot == none) continue;
        visit(k, plan.mesh().points[k], wall_move(plan, basis, slot, turn));
    }
}

}  // namespace harmorph
