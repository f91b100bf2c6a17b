// Improves a mesh of a plan: targets are the cells before a movement; the first layers on walls get
// back their heights.
#pragma once

#include "boundary/first_layer.hpp"
#include "safe/improve.hpp"
#include "safe/mobility.hpp"

namespace harmorph {

struct MeshImprovement {
    Mobility mobility;
    FirstLayer first_layer;
    Improvement improvement;
    Span<Vec2> start;  // [n_points] `from`, with the first layer as the wall carries it; at the end
                       // the result

    void lay_out(Arena& arena, Plan const& plan) noexcept;

    // Refuses coordinates out of range and inverted cells.
    static Status check(Plan const& plan, Points reference, Points from, Fault& fault) noexcept;
    // reference, from: coordinates of the plan's mesh before and after a movement, as check()
    // accepts them; to: the better ones; may be `from`. The tops of the first layer (the ends of
    // the edges that leave walls most normal to them) are put where the wall carries them, at the
    // height and the angle that they had, as far as no cell inverts, and held there; only a top of
    // a cell that has less than half of its quality then may move on. If the smallest quality ends
    // below that of `from`, or must end there as a cell below it has no point that moves, all is
    // done with the tops where they are in `from`. The plan's distances are left at the reference.
    void run(Plan& plan, ImproveOptions const& options, Points reference, Points from,
             MutablePoints to, ImproveReport& report) noexcept;

private:
    void carry_first_layer(Points reference, Points from) noexcept;
    bool try_top(Index top, Vec2 at, Points from) noexcept;
    Vec2 position(Index point, Points from) const noexcept;
    void hold_first_layer(Plan const& plan, Points reference) noexcept;
    Real smallest_held(Plan const& plan, Points reference) const noexcept;
};

}  // namespace harmorph
