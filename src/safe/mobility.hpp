// Finds which points of a mesh an optimisation may move, and how, according to the conditions of
// the plan.
#pragma once

#include "plan/plan.hpp"
#include "safe/region.hpp"
#include "safe/slipping_points.hpp"

namespace harmorph {

// Inner points move in any direction, slipping points along their lines and curves, points of a cut
// or of a periodic pair together, and points of a rotation pair together with one of them turned.
// Points on walls, on fixed boundaries and on free boundaries are held: the operator alone decides
// how a free boundary moves. Slipping points that are not on their curves, or that other points are
// joined to, are held, too.
struct Mobility {
    Span<Index> representative;
    Span<std::uint8_t> held;
    Span<Vec2> line;          // empty if no point slips; see Tangle
    Span<Vec2> turn;          // empty if no sides are turned; see Tangle
    SlippingPoints slipping;  // the points that slip along curves; their lines are in `line`

    void lay_out(Arena& arena, Plan const& plan) noexcept;
    // The points are at `now`.
    void find(Plan const& plan, Points now) noexcept;
    Tangle tangle(Plan const& plan, Points reference) const noexcept {
        return {plan.mesh(), reference, plan.cells().reversed, representative, held, line, turn};
    }
};

}  // namespace harmorph
