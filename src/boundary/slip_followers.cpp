#include "boundary/slip_followers.hpp"

namespace harmorph {
namespace {

// Fewer points are not given to a thread, because starting a thread takes longer.
constexpr Index min_followers = 4096;

// Distinguishes the faces of curves and the faces of other boundaries.
struct Faces {
    Boundary const& boundary;
    Span<const Condition> conditions;
    Span<const Index> slot_at;

    ConditionKind kind(Index face) const noexcept {
        const Condition* const condition = condition_of(conditions, boundary, face);
        return condition == nullptr ? ConditionKind::fixed : condition->kind;
    }
    bool is_on_curve(Index face) const noexcept {
        return kind(face) == ConditionKind::slip && slot_at[boundary.point[face]] != none;
    }
    // Returns whether the points of the face follow, like inner points.
    bool follows(Index face) const noexcept {
        if (kind(face) == ConditionKind::free || kind(face) == ConditionKind::periodic) return true;
        for (Condition const& condition : conditions) {
            if (condition.kind == ConditionKind::periodic &&
                condition.partner == boundary.marker[face])
                return true;
        }
        return false;
    }
    bool is_other(Index face) const noexcept { return !follows(face) && !is_on_curve(face); }
};

// Finds the slot at which each point begins a face of a curve.
void find_slots(SlipCurves const& curves, Span<Index> slot_at) noexcept {
    fill(slot_at, none);
    for (Index curve = 0; curve < curves.count; ++curve) {
        for (Index k = curves.start[curve]; k + 1 < curves.start[curve + 1]; ++k)
            slot_at[curves.point[k]] = k;
    }
}

// Calls body(point) for the points that follow.
template <class Body>
void for_followers(Span<const PointKind> kinds, Executor const& executor,
                   Body const& body) noexcept {
    executor.for_ranges(kinds.count(), min_followers, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            if (kinds[k] == PointKind::inside || kinds[k] == PointKind::free) body(k);
        }
    });
}

// Returns (o / (s + o))^(exponent_quarters / 4 + 1).
Real share_of(Real from_curve, Real from_others, Index exponent_quarters) noexcept {
    Real const nearness = from_others < infinity ? from_others / (from_curve + from_others) : 1;
    Real const root = sqrt(sqrt(nearness));
    Real share = nearness;
    for (Index i = 0; i < exponent_quarters; ++i) share *= root;
    return share;
}

// A point that is joined to another point follows like that point, or follows only that point if it
// slips.
void follow_representatives(Topology const& topology, Span<const PointKind> kinds,
                            SlipCurves const& curves, SlipFollowers const& followers) noexcept {
    Span<Index> const slot = followers.slot;
    Span<Real> const weight = followers.weight;
    for (Index k = 0; k < slot.count(); ++k) {
        Index const same = topology.representative[k];
        if (same == k) continue;
        slot[k] = slot[same];
        weight[2 * k] = weight[2 * same];
        weight[2 * k + 1] = weight[2 * same + 1];
        if (kinds[same] != PointKind::slip) continue;
        curves.for_each([&](Index number, Index point) {
            if (point == same) slot[k] = number;
        });
        weight[2 * k] = 1;
        weight[2 * k + 1] = 0;
    }
}

}  // namespace

void SlipFollowers::lay_out(Arena& arena, Index n_points, Size max_faces) noexcept {
    lay_out_copy(arena, n_points);
    faces.lay_out(arena, max_faces);
    arena.take(slot_at, n_points);
}

void SlipFollowers::lay_out_copy(Arena& arena, Index n_points) noexcept {
    arena.take(slot, n_points);
    arena.take(weight, 2 * Offset{n_points});
}

void SlipFollowers::copy_from(SlipFollowers const& other) noexcept {
    if (slot.empty()) return;
    copy(slot, Span<const Index>(other.slot));
    copy(weight, Span<const Real>(other.weight));
}

void SlipFollowers::find(Topology const& topology, Boundary const& boundary,
                         Span<const Condition> conditions, Span<const PointKind> kinds,
                         SlipCurves const& curves, Index exponent_quarters,
                         Executor const& executor) noexcept {
    if (curves.count == 0) {
        slot = {};
        weight = {};
        return;
    }
    Points const points = topology.mesh.points;
    Faces const by_kind{boundary, conditions, slot_at};
    find_slots(curves, slot_at);
    fill(slot, none);
    faces.choose(boundary, [&](Index face) { return by_kind.is_on_curve(face); });
    faces.build(points);
    for_followers(kinds, executor, [&](Index k) {
        Index no_guess = 0;
        FaceDistance::Foot const foot = faces.foot(points[k], no_guess);
        if (foot.face == none) return;
        slot[k] = slot_at[faces.faces[foot.face].point[0]];
        weight[2 * k] = foot.t;
        weight[2 * k + 1] = length(points[k] - faces.at(foot, points));
    });
    faces.choose(boundary, [&](Index face) { return by_kind.is_other(face); });
    faces.build(points);
    for_followers(kinds, executor, [&](Index k) {
        if (slot[k] == none) return;
        Real const t = weight[2 * k];
        Real const share =
            share_of(weight[2 * k + 1], faces.distance(points[k]), exponent_quarters);
        weight[2 * k] = (1 - t) * share;
        weight[2 * k + 1] = t * share;
    });
    follow_representatives(topology, kinds, curves, *this);
}

}  // namespace harmorph
