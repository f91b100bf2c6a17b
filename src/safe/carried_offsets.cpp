#include "safe/carried_offsets.hpp"

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

void CarriedOffsets::init(Basis const& basis, MovementPath const& path, Points start) noexcept {
    forget();
    has_groups = false;
    Real largest = 0, extent = 0;
    for (Index slot = 0; slot < wall.count(); ++slot) {
        wall[slot] = {};
        if (!basis.is_on_curve(slot) || path.groups[path.group_of_slot(basis, slot)].is_straight())
            continue;
        Curve const curve = basis.curve(basis.wall_curve[slot]);
        wall[slot] = start[basis.wall_point[slot]] - curve_point(curve, basis.wall_u[slot]) -
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
    TurnAt turn(path, t);
    Real longest = 0;
    for (Index slot = 0; slot < wall.count(); ++slot)
        longest = max(longest, length(of_wall(basis, path, slot, turn)));
    return longest;
}

void CarriedOffsets::add(MovementPath const& path, Real from, Real to, MutablePoints displacement,
                         Executor const& executor) const noexcept {
    if (reach == 0) return;
    executor.for_ranges(group.count(), min_carried_points, [&](Index begin, Index end) {
        TurnAt before(path, from), after(path, to);
        for (Index k = begin; k < end; ++k) {
            if (group[k] == none) continue;
            Vec2 const turn = quotient(after.of(group[k]), before.of(group[k]));
            Vec2 const by = product(turn - Vec2{1, 0}, {x[k], y[k]});
            displacement.set(k, Vec2{displacement.x[k], displacement.y[k]} + by);
        }
    });
}

}  // namespace harmorph
