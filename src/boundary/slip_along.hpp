// Boundaries along which points slide as a given B-spline has it, instead of as their own points
// have it.
//
// The curve is C(u) + e, e the offsets of the points from C, linear in u between two points: so
// points are on it where they start. A point where an open curve ends, or where a closed one has
// its corner, is a corner of the boundary.
#pragma once

#include "boundary/moving_boundary.hpp"
#include "boundary/slip_curves.hpp"

namespace harmorph {

struct SlipAlong {
    Span<const Curve> curves;  // those of all conditions; none: no condition has any
    WallWork work;             // `slot` is not used

    static bool is_along(const Condition* condition) noexcept {
        return condition != nullptr && condition->kind == ConditionKind::slip &&
               condition->n_curves > 0;
    }
    // Which faces begin at a corner.
    void find_corners(Points points, Boundary const& boundary,
                      Span<const Condition> conditions) const noexcept;
    bool is_corner(Index face) const noexcept { return work.is_break[face] != 0; }

    // Adds the curve through the positions work.position [n + 1], of a closed line [n]: the one of
    // the condition's curves that is nearest. Refused (Status::bad_condition): positions that are
    // farther from it than a twentieth of their line's length, and where it has a corner between
    // them, or turns by more than 30 degrees in an eighth of a face.
    template <class PointOf>
    Status add(Condition const& condition, Index n, bool closed, PointOf const& point_of,
               SlipCurves& to, Fault& fault) const noexcept {
        Span<const Vec2> const position = work.position;
        to.add(
            n, closed, [&](Index k) { return position[closed && k == n ? 0 : k]; }, point_of);
        return give(condition, n, closed, to, fault);
    }

private:
    Status give(Condition const& condition, Index n, bool closed, SlipCurves& to,
                Fault& fault) const noexcept;
};

}  // namespace harmorph
