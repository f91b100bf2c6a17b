// Finds slip boundaries whose points slip along a given B-spline C, instead of a curve through the
// points themselves.
//
// The points slip along C(u) + e, where e is the offset of the points from C and varies linearly
// in u between two points. The points therefore lie on this curve at the start. A point at which an
// open B-spline ends, or a closed one has a corner, is a corner of the boundary.
#pragma once

#include "boundary/moving_boundary.hpp"
#include "boundary/slip_curves.hpp"

namespace harmorph {

struct SlipAlong {
    Span<const Curve> curves;  // the curves for slip of all conditions; may be empty
    WallWork work;             // work.slot is not used

    static bool is_along(const Condition* condition) noexcept {
        return condition != nullptr && condition->kind == ConditionKind::slip &&
               condition->n_curves > 0;
    }
    // Finds the faces that begin at a corner.
    void find_corners(Points points, Boundary const& boundary,
                      Span<const Condition> conditions) const noexcept;
    bool is_corner(Index face) const noexcept { return work.is_break[face] != 0; }

    // Adds the curve through the positions work.position [n + 1], or [n] for a closed line, along
    // the nearest of the condition's curves. Refuses (Status::bad_condition) positions that are
    // farther from this curve than a twentieth of the length of the line. Also refuses a curve that
    // has a corner between two positions, or turns by more than 30 degrees in an eighth of a face.
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
