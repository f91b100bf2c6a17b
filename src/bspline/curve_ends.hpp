// Decides how a fitted curve closes: where the curve begins, in which direction it runs round the
// body, and which corners are on it.
#pragma once

#include "bspline/corners.hpp"

namespace harmorph {

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
// the outline turns most. An open curve that the caller chooses runs from the first point to the
// last.
//
// A base is a straight side between two consecutive corners, at the end of the section farthest
// from the leading edge. The outline reverses there: the directions before the first corner and
// after the second one are nearly opposite, and the outline turns by at least 25 degrees at either
// corner. At facets of a rounded edge with few points the outline turns less, so they are not
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
