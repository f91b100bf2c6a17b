// Computes turning and curvature of an outline, which is given as points in order, and finds
// corners and short straight sides.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// The origin is the centroid of the points, and the unit of length is the extent, which is nearly
// the largest distance of two points.
struct Outline {
    Span<const Vec2> points;
    bool is_loop = false;
    Span<Real> arc;  // [n + 1] the arc length up to each point; the last entry is the total length
    // [n] 2 sin(angle / 2) of the change of direction, which is the angle if it is small; 0 at open
    // ends.
    Span<Real> turn;
    Span<Real> curvature;  // [n] 1 / radius

    void lay_out(Arena& arena, Index n) noexcept;
    // Computes arc, turn and curvature from the points.
    void measure() noexcept;

    Index count() const noexcept { return points.count(); }
    // Return the first point ahead or behind whose arc length from `point` is at least `reach`, or
    // none if an open end is nearer. The result is never the point itself.
    Index ahead(Index point, Real reach) const noexcept;
    Index behind(Index point, Real reach) const noexcept;
};

// Writes the points at which the direction jumps to corner [n], in order, and returns their number.
// A rounded leading or trailing edge with few points turns as sharply from point to point, but over
// more than two points; its points are not corners.
Index find_corners(Outline const& outline, Span<Index> corner) noexcept;

// Returns whether the points from corner `from` to corner `to` lie on a straight line of at most
// the length `longest`.
bool is_straight_side(Outline const& outline, Index from, Index to, Real longest) noexcept;

}  // namespace harmorph
