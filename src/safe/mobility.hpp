// Which points of a mesh an optimisation may move, and how: by the conditions of its plan.
#pragma once

#include "plan/plan.hpp"
#include "safe/region.hpp"
#include "safe/sliding_points.hpp"

namespace harmorph {

// Points inside move anywhere, sliding points along their lines and curves, points of a cut or a
// periodic pair as one, those of a rotation pair as one that is turned. Points on walls, on fixed
// and on free boundaries are held: where a free boundary goes, the operator alone says. Sliding
// points that are not on their curves, or that others are joined to, are held, too.
struct Mobility {
    Span<Index> representative;
    Span<std::uint8_t> held;
    Span<Vec2> line;        // empty where nothing slides; see Tangle
    Span<Vec2> turn;        // empty where no sides are turned; see Tangle
    SlidingPoints sliding;  // along curves; their lines are those above

    void lay_out(Arena& arena, Plan const& plan) noexcept;
    // now: where the points are.
    void find(Plan const& plan, Points now) noexcept;
    Tangle tangle(Plan const& plan, Points reference) const noexcept {
        return {plan.mesh(), reference, plan.cells().reversed, representative, held, line, turn};
    }
};

}  // namespace harmorph
