// Improves a mesh of a plan: the targets are the cells before a movement, and the first layers on
// walls get their heights back.
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
    // The arrays `reference` and `from` are coordinates of the plan's mesh before and after a
    // movement, which check() has accepted; the improved coordinates are written to `to`, which may
    // be `from`. The tops of the first layer are the ends of those edges that leave walls most
    // nearly along the normal. They are put where the wall carries them, with their former height
    // and angle, as far as no cell is inverted, and are held there; only a top of a cell that has
    // less than half of its former quality may then move on. If the smallest quality ends below
    // that of `from`, or must do so because a cell below it has no movable point, everything is
    // repeated with the tops where they are in `from`. The plan's distances are left at the
    // reference.
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
