#include "safe/moving_mesh.hpp"

#include "morph/morph.hpp"

namespace harmorph {

namespace {

// A task has at least this many points.
constexpr Index min_carried_points = 4096;
// Offsets below this part of the extent of the control points are rounding.
constexpr Real min_residual = 1e-12;

Real fade_of_offset(Real x) noexcept { return x < 1 ? (1 - x) * (1 - x) * (1 + 2 * x) : 0; }

}  // namespace

void CarriedOffsets::lay_out(Arena& arena, BasisCounts const& counts) noexcept {
    arena.take(wall, counts.wall);
    arena.take(x, counts.points);
    arena.take(y, counts.points);
    arena.take(group, counts.points);
    arena.take(fade, counts.points);
    arena.take(control, 2 * Offset{counts.functions()});
}

void CarriedOffsets::init(Basis const& basis, MovementPath const& path) noexcept {
    forget();
    has_groups = false;
    Real largest = 0, extent = 0;
    for (Index slot = 0; slot < wall.count(); ++slot) {
        wall[slot] = {};
        if (!basis.is_on_curve(slot) || path.groups[path.group_of_slot(basis, slot)].is_straight())
            continue;
        Curve const curve = basis.curve(basis.wall_curve[slot]);
        wall[slot] = basis.wall_start[slot] - curve_point(curve, basis.wall_u[slot]) -
                     basis.wall_offset[slot];
        largest = max(largest, length(wall[slot]));
        extent = max(extent, length(path.start[curve.control_point(0)]));
    }
    reach = largest > min_residual * extent ? reach_per_residual * largest : 0;
    if (reach == 0) fill(wall, Vec2{});
}

void CarriedOffsets::find_groups(Basis const& basis, MovementPath const& path, Points start,
                                 FaceDistance& walls, Span<const Index> representative,
                                 Span<const std::uint8_t> held, Executor const& executor) noexcept {
    if (reach == 0 || has_groups) return;
    has_groups = true;
    walls.build(start);
    executor.for_ranges(group.count(), min_carried_points, [&](Index begin, Index end) {
        Index nearest = 0;
        for (Index k = begin; k < end; ++k) {
            group[k] = none;
            if (held[k] != 0 || representative[k] != k || !walls.may_reach(start[k], reach))
                continue;
            FaceDistance::Foot const foot = walls.foot(start[k], nearest);
            if (foot.face == none) continue;
            Index const slot = path.slot_of[walls.faces[foot.face].point[0]];
            if (slot == none || !basis.is_on_curve(slot)) continue;
            Index const group_of_point = path.group_of_slot(basis, slot);
            fade[k] = fade_of_offset(length(start[k] - walls.at(foot, start)) / reach);
            if (fade[k] > 0 && !path.groups[group_of_point].is_straight())
                group[k] = group_of_point;
        }
    });
    for (Index k = 0; k < group.count(); ++k) {
        if (held[k] == 0) group[k] = group[representative[k]];
    }
}

void CarriedOffsets::find(Basis const& by, Span<const Real> reached, Points now,
                          Span<const Index> representative, Executor const& executor) noexcept {
    if (reach == 0 || found_with == by.value.data()) return;
    found_with = by.value.data();
    Index const n_control = by.header->counts.control;
    for (Index i = 0; i < control.count(); ++i)
        control[i] = i < 2 * n_control ? by.control[i] + reached[i] : 0;
    morph(by, control.data(), {}, {x.data(), y.data(), 1}, executor);
    for (Index k = 0; k < group.count(); ++k) {
        if (group[k] == none || representative[k] != k) continue;
        x[k] = fade[k] * (now[k].x - x[k]);
        y[k] = fade[k] * (now[k].y - y[k]);
    }
    // Points of a cut or of a pair move alike.
    for (Index k = 0; k < group.count(); ++k) {
        if (group[k] == none) continue;
        x[k] = x[representative[k]];
        y[k] = y[representative[k]];
    }
}

Real CarriedOffsets::largest(Basis const& basis, MovementPath const& path, Real t) const noexcept {
    RotationAt rotation(path, t);
    Real longest = 0;
    for (Index slot = 0; slot < wall.count(); ++slot)
        longest = max(longest, length(of_wall(basis, path, slot, rotation)));
    return longest;
}

void CarriedOffsets::add(MovementPath const& path, Real from, Real to, MutablePoints displacement,
                         Executor const& executor) const noexcept {
    if (reach == 0) return;
    executor.for_ranges(group.count(), min_carried_points, [&](Index begin, Index end) {
        RotationAt before(path, from), after(path, to);
        for (Index k = begin; k < end; ++k) {
            if (group[k] == none) continue;
            Vec2 const rotation = quotient(after.of(group[k]), before.of(group[k]));
            Vec2 const by = product(rotation - Vec2{1, 0}, {x[k], y[k]});
            displacement.set(k, Vec2{displacement.x[k], displacement.y[k]} + by);
        }
    });
}

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
    carried.init(basis, path);
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
    carried.find_groups(basis, path, plan.mesh().points, plan.equations().walls(), representative,
                        held, executor);
    carried.find(by, reached, now(), representative, executor);
    carried.add(path, time, to, to_ahead(), executor);
    if (carried.reach > 0)
        for_wall(plan, basis, [&](Index k, Vec2 start, Vec2 moved) {
            to_ahead().set(k, start + moved - now()[k]);
        });
    put_on_slip_curves(plan);
    AdmissibleStep const limit =
        admissible_step(plan.equations().cells(), now(), ahead(), executor);
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
                           RotationAt& rotation) const noexcept {
    if (basis.is_given(slot) && !given.empty() && aimed_time >= 1)
        return given[slot - plan.given().first_slot];
    return basis.wall_move(slot, aimed.data()) + carried.of_wall(basis, path, slot, rotation);
}

template <class Visit>
void MovingMesh::for_wall(Plan const& plan, Basis const& basis, Visit const& visit) const noexcept {
    RotationAt rotation(path, aimed_time);
    for (Index k = 0; k < plan.mesh().n_points; ++k) {
        Index const slot = plan.unknowns().wall_slot(k);
        if (slot == none) continue;
        visit(k, plan.mesh().points[k], wall_move(plan, basis, slot, rotation));
    }
}

}  // namespace harmorph
