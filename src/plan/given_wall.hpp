// The data of the boundary that a plan keeps for displacements that are given from call to call.
// tests/morph/test_displacement.cpp covers this file.
#pragma once

#include "plan/analysis.hpp"

namespace harmorph {

// The arrays are empty if no displacements are given.
struct GivenWall {
    // This many fields are solved as one block of right-hand sides.
    static constexpr Index fields_at_once = 12;

    Span<Index> point;     // [given points] The points in the order of their slots.
    Index first_slot = 0;  // The given slots begin here.
    // The points that are joined to another one: beyond a cut, or periodic images.
    Span<Index> joined;
    Span<Index> boundary_point, loop_start, interface_side;  // See BoundaryFaces.

    BoundaryFaces faces() const noexcept { return {boundary_point, loop_start, interface_side}; }

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // Returns the number of right-hand sides of a block of fields, or 0 without given
    // displacements.
    static Index columns(Analysis const& analysis) noexcept;
};

}  // namespace harmorph
