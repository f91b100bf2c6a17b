// Finds which points of a mesh an optimisation may move, and how, according to the conditions of
// the plan.
#pragma once

#include "plan/plan.hpp"
#include "base/vec2.hpp"
#include "boundary/slip.hpp"
#include "safe/region.hpp"

namespace harmorph {

// Points that slip along curves while an optimisation moves mesh points: a step moves them along
// their tangents, and then they are put back onto their curves.

struct SlippingPoints {
    // A point does not slip if its distance to its curve is larger than this part of the faces
    // there.
    static constexpr Real max_distance_to_face = 1e-6;

    const SlipCurves* curves = nullptr;
    // [n_points] The number of a point in the curves; none if it does not slip along a curve.
    // Empty: no point slips.
    Span<Index> slot;
    Span<Vec2> line;  // [n_points] see Tangle

    Vec2 placed(Index point, Vec2 p) const noexcept {
        return slips(point) ? curves->nearest(slot[point], p).at : p;
    }
    bool slips(Index point) const noexcept { return !slot.empty() && slot[point] != none; }

    // Finds the points that are on their curves in `now`; the others are held. Points that other
    // points are joined to are held, too.
    void find(SlipCurves const& slip_curves, Points now, Span<const Index> representative,
              Span<std::uint8_t> held) noexcept;
    // Sets the lines to the tangents at the present positions.
    void rotate_lines(Points now) const noexcept;
};

// Inner points move in any direction, slipping points along their lines and curves, points of a cut
// or of a periodic pair together, and points of a rotation pair together with one of them rotated.
// Points on walls, on fixed boundaries and on free boundaries are held: the operator alone decides
// how a free boundary moves. Slipping points that are not on their curves, or that other points are
// joined to, are held, too.
struct Mobility {
    Span<Index> representative;
    Span<std::uint8_t> held;
    Span<Vec2> line;          // empty if no point slips; see Tangle
    Span<Vec2> rotation;      // empty if no sides are rotated; see Tangle
    SlippingPoints slipping;  // the points that slip along curves; their lines are in `line`

    void lay_out(Arena& arena, Plan const& plan) noexcept;
    // The points are at `now`.
    void find(Plan const& plan, Points now) noexcept;
    Tangle tangle(Plan const& plan, Points reference) const noexcept {
        return {plan.mesh(), reference, plan.equations().cells().reversed, representative, held,
                line,        rotation};
    }
};

}  // namespace harmorph
