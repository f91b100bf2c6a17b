// Decides how a fitted curve closes: where the curve begins, in which direction it runs round the
// body, and which corners are on it.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// Computes turning and curvature of an outline, which is given as points in order, and finds
// corners and short straight sides.

// The origin is the centroid of the points, and the unit of length is the extent, which is nearly
// the largest distance of two points.
struct Outline {
    Span<const Vec2> points;
    bool is_loop = false;
    Span<Real> arc;  // [n + 1] the arc length up to each point; the last entry is the total length
    // [n] 2 sin(angle / 2) of the change of direction, which is the angle if it is small; 0 at open
    // ends.
    Span<Real> turning;
    Span<Real> curvature;  // [n] 1 / radius

    void lay_out(Arena& arena, Index n) noexcept;
    // Computes arc, turning and curvature from the points.
    void measure() noexcept;

    Index count() const noexcept { return points.count(); }
    // Return the first point ahead or behind whose arc length from `point` is at least `reach`, or
    // none if an open end is nearer. The result is never the point itself.
    Index ahead(Index point, Real reach) const noexcept;
    Index behind(Index point, Real reach) const noexcept;
};

// Writes the points at which the direction jumps to corner [n], in order, and returns their number.
// A rounded leading or trailing edge with few points bends as sharply from point to point, but over
// more than two points; its points are not corners.
Index find_corners(Outline const& outline, Span<Index> corner) noexcept;

// Returns whether the points from corner `from` to corner `to` lie on a straight line of at most
// the length `longest`.
bool is_straight_side(Outline const& outline, Index from, Index to, Real longest) noexcept;

enum class Closure : std::int32_t { automatic = 0, open = 1, tied = 2, periodic = 3 };

// The positions 0 .. n_positions - 1 of the curve are the points first, first + 1, ... (mod n). A
// tied or periodic curve has the first point at both ends.
struct Course {
    Closure closure = Closure::open;
    Index first = 0;
    Index n_positions = 0;
    // The number of points on the blunt base, for which there is a second curve; both ends count.
    Index base_points = 0;

    bool closes() const noexcept {
        return closure == Closure::tied || closure == Closure::periodic;
    }
};

// Chooses the course of the curve. With Closure::automatic, the curve of a loop is periodic if
// there are no corners, open if there is a blunt base, and otherwise tied at the sharpest corner.
// The open curve runs the long way from one corner of the base to the other. If the caller chooses
// tied or periodic, the curve begins at the sharpest corner, or without corners at the point where
// the outline bends most. An open curve that the caller chooses runs from the first point to the
// last.
//
// A base is a straight side between two consecutive corners, at the end of the section farthest
// from the leading edge. The outline reverses there: the directions before the first corner and
// after the second one are nearly opposite, and the outline bends by at least 25 degrees at either
// corner. At facets of a rounded edge with few points the outline bends less, so they are not
// bases. The last panel before a trailing edge of one point is no base, nor is the facet across the
// round leading edge of a section with few points and a sharp trailing edge. The two ends of a
// plate are not bases either, because a plate has no leading edge.
Course choose_course(Outline const& outline, Span<const Index> corner, Closure wanted) noexcept;

// Removes both corners of each facet of a round edge, a short straight side with less than 60
// degrees of turning at either end. The corners of a base stay. Returns the number of corners left.
Index drop_facets(Outline const& outline, Span<Index> corner, Index n) noexcept;

// Replaces the points in `corner` by their positions inside the course, in ascending order, and
// keeps the max_corners sharpest. A periodic curve is smooth and has no corners. Returns the number
// of corners left.
Index corners_on(Course const& course, Outline const& outline, Span<Index> corner,
                 Index max_corners) noexcept;

}  // namespace harmorph
