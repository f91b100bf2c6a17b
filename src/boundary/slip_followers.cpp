#include "boundary/slip_followers.hpp"

namespace harmorph {
namespace {

constexpr Index least_followers = 4096;  // for a thread

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
                         SlipCurves const& curves, Index quarters,
                         Executor const& executor) noexcept {
    if (curves.count == 0) {
        slot = {};
        weight = {};
        return;
    }
    Points const points = topology.mesh.points;
    Span<const Index> const representative = topology.representative;
    fill(slot, none);
    fill(slot_at, none);
    for (Index curve = 0; curve < curves.count; ++curve) {
        for (Index k = curves.start[curve]; k + 1 < curves.start[curve + 1]; ++k)
            slot_at[curves.point[k]] = k;
    }
    auto const condition_kind = [&](Index face) {
        const Condition* const condition = condition_of(conditions, boundary, face);
        return condition == nullptr ? ConditionKind::fixed : condition->kind;
    };
    auto const is_on_curve = [&](Index face) {
        return condition_kind(face) == ConditionKind::slip && slot_at[boundary.point[face]] != none;
    };
    auto const is_partner = [&](Index face) {
        for (Condition const& condition : conditions) {
            if (condition.kind == ConditionKind::periodic &&
                condition.partner == boundary.marker[face])
                return true;
        }
        return false;
    };
    auto const for_followers = [&](auto const& body) {
        executor.for_ranges(slot.count(), least_followers, [&](Index begin, Index end) {
            for (Index k = begin; k < end; ++k) {
                if (kinds[k] == PointKind::inside || kinds[k] == PointKind::free) body(k);
            }
        });
    };
    faces.choose(boundary, is_on_curve);
    faces.build(points);
    for_followers([&](Index k) {
        Index no_guess = 0;
        FaceDistance::Foot const foot = faces.foot(points[k], no_guess);
        if (foot.face == none) return;
        slot[k] = slot_at[faces.faces[foot.face].point[0]];
        weight[2 * k] = foot.t;
        weight[2 * k + 1] = length(points[k] - faces.at(foot, points));
    });
    faces.choose(boundary, [&](Index face) {
        ConditionKind const kind = condition_kind(face);
        bool const goes_along =
            kind == ConditionKind::free || kind == ConditionKind::periodic || is_partner(face);
        return !goes_along && !is_on_curve(face);
    });
    faces.build(points);
    for_followers([&](Index k) {
        if (slot[k] == none) return;
        Real const t = weight[2 * k], from_curve = weight[2 * k + 1],
                   from_others = faces.distance(points[k]);
        Real const nearness = from_others < infinity ? from_others / (from_curve + from_others) : 1;
        Real const root = square_root(square_root(nearness));
        Real part = nearness;
        for (Index i = 0; i < quarters; ++i) part *= root;
        weight[2 * k] = (1 - t) * part;
        weight[2 * k + 1] = t * part;
    });
    for (Index k = 0; k < slot.count(); ++k) {
        Index const same = representative[k];
        if (same == k) continue;
        slot[k] = slot[same];
        weight[2 * k] = weight[2 * same];
        weight[2 * k + 1] = weight[2 * same + 1];
        if (kinds[same] != PointKind::slip) continue;
        curves.for_each([&](Index its, Index point) {
            if (point == same) slot[k] = its;
        });
        weight[2 * k] = 1;
        weight[2 * k + 1] = 0;
    }
}

}  // namespace harmorph
