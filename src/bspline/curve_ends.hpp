// How a fitted curve closes: where the curve begins, which way it runs round the body, and which
// corners are on it.
#pragma once

#include "bspline/corners.hpp"

namespace harmorph {

enum class Closure : std::int32_t { automatic = 0, open = 1, tied = 2, periodic = 3 };

// Why a curve closes as it does.
enum class ClosureReason : std::int32_t {
    wish = 0,
    no_loop = 1,
    no_corner = 2,
    corner = 3,
    base = 4
};

// The curve's positions 0 .. n_positions - 1 are the points first, first + 1, ... (mod n). A tied
// or periodic curve has the first point at both ends.
struct Course {
    Closure closure = Closure::open;
    ClosureReason reason = ClosureReason::no_loop;
    Index first = 0;
    Index n_positions = 0;
    Index base_points =
        0;  // points on the blunt base, which a second curve takes; both ends counted

    bool closes() const noexcept {
        return closure == Closure::tied || closure == Closure::periodic;
    }
};

// Automatic, for a loop: without corners periodic; with a blunt base open, the long way from one
// corner of the base to the other; else tied at the sharpest corner. Tied or periodic as the caller
// chooses: begins at the sharpest corner, or without corners at the point where the outline turns
// most. Open: from the first point to the last.
//
// A base is a straight piece from a corner to the next one, at the end of the section farthest from
// the nose, where the outline reverses: the directions before the first corner and behind the
// second are nearly opposite, and the outline turns by at least 25 degrees at either corner. Facets
// of a nose or of a rounded edge with few points are no bases, as the outline turns less there.
// Neither is the last panel before a trailing edge of one point, nor are the two ends of a plate,
// which has no nose.
Course choose_course(Outline const& outline, Span<const Index> corner, Closure wanted) noexcept;

// Removes both corners of a short straight piece with less than 60 degrees of turning at either: a
// facet of a round edge. The corners of a base stay. Returns how many corners are left.
Index drop_facets(Outline const& outline, Span<Index> corner, Index n) noexcept;

// Turns corners (points) into those inside the course (positions, ascending), the sharpest `most`
// of them; a periodic curve is to be smooth and has none. Returns how many are left.
Index corners_on(Course const& course, Outline const& outline, Span<Index> corner,
                 Index most) noexcept;

}  // namespace harmorph
