// Improves a mesh of a plan: targets are the cells before a movement; the first layers on walls stay as they are.
#pragma once

#include "harmorph/boundary/first_layer.hpp"
#include "harmorph/safe/improve.hpp"
#include "harmorph/safe/mobility.hpp"

namespace harmorph {

struct MeshImprovement {
    Mobility mobility;
    FirstLayer first_layer;
    Improvement improvement;

    void lay_out(Arena& arena, Plan const& plan) noexcept;

    // reference, from: coordinates of the plan's mesh before and after a movement; to: where the better ones go, and
    // all others from `from`; may be the same. The tops of the first layer (the ends of the edges that leave the walls
    // most normal to them) are held, so that heights and angles at walls are kept to the last bit; only a top of a cell
    // with less than half of the quality it had may move. The plan's distances are left at the reference. Refused, with
    // `to` as it was: an inverted cell, a coordinate out of range.
    Status run(Plan& plan, ImproveOptions const& options, Points reference, Points from, MutablePoints to,
               ImproveReport& report, Fault& fault) noexcept;

private:
    Status check(Plan const& plan, Points points, const char* inverted_cell, Fault& fault) const noexcept;
    void hold_first_layer(Plan const& plan, Points reference, Points points) noexcept;
};

}  // namespace harmorph
