// The outline of a body as points in order: turning, curvature, corners, straight pieces.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// Points about their centroid in units of the extent (nearly the largest distance of two points):
// all lengths are fractions of it.
struct Outline {
    Span<const Vec2> points;
    bool is_loop = false;
    Span<Real> arc;   // [n + 1] arc length up to each point; the last: of all (of a loop, round it)
    Span<Real> turn;  // [n] 2 sin(angle / 2) of the change of direction: the angle, for small ones;
                      // 0 at open ends
    Span<Real> curvature;  // [n] 1 / radius

    void lay_out(Arena& arena, Index n) noexcept;
    void measure() noexcept;  // fills arc, turn and curvature from points

    Index count() const noexcept { return points.count(); }
    // The first point at least `reach` of arc length away (never the point itself); none: an open
    // end is nearer.
    Index ahead(Index point, Real reach) const noexcept;
    Index behind(Index point, Real reach) const noexcept;
};

// The points where the direction jumps, in order: corner [n]; returns how many. Rounded noses and
// edges with few points turn as sharply from point to point, but over more than two points: they
// are not corners.
Index find_corners(Outline const& outline, Span<Index> corner) noexcept;

// Do the points from corner `from` to corner `to` lie on a straight line that is short compared
// with the body?
bool is_short_side(Outline const& outline, Index from, Index to) noexcept;

}  // namespace harmorph
