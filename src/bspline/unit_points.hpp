// Checks points in order and scales them by their extent, with the centroid as the origin, so that
// tolerances and rounding do not depend on the unit and origin of the caller.
// tests/bspline/test_fit.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"

namespace harmorph {

struct UnitPoints {
    Span<Vec2> at;    // [n] (point - centre) / extent
    Vec2 centre;      // [length] the centroid of the caller's points
    Real extent = 1;  // [length] nearly the largest distance between two of the points

    void lay_out(Arena& arena, Index n) noexcept { arena.take(at, n); }
    // Refuses points that are not finite or beyond 1e100, equal consecutive points, and an open
    // line whose ends are equal.
    Status take(Points points, Index n, bool is_loop, Fault& fault) noexcept;

    Vec2 to_unit(Vec2 p) const noexcept { return (1 / extent) * (p - centre); }
    Vec2 from_unit(Vec2 p) const noexcept { return centre + extent * p; }
};

}  // namespace harmorph
