// What a plan keeps of the boundary for displacements that are given from call to call.
#pragma once

#include "plan/analysis.hpp"

namespace harmorph {

// Empty where no displacements are given.
struct GivenWall {
    static constexpr Index fields_at_once = 12;  // that are solved as one block of right-hand sides

    Span<Index> point;     // [given points] in the order of their slots
    Index first_slot = 0;  // the slots from here on are given
    Span<Index> joined;    // points joined to another one: beyond a cut, or periodic images
    Span<Index> boundary_point, loop_start, interface_side;  // see BoundaryFaces

    BoundaryFaces faces() const noexcept { return {boundary_point, loop_start, interface_side}; }

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // Right-hand sides of such a block.
    static Index columns(Analysis const& analysis) noexcept;
};

}  // namespace harmorph
