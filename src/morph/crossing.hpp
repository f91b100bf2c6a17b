// Finds out whether the boundary crosses itself, or one body another one. Positive cell areas do
// not exclude that.
#pragma once

#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// Two faces, each given by the points where it begins and ends.
struct Crossing {
    bool found = false;
    Index first[2] = {none, none};
    Index second[2] = {none, none};
};

// Points that slip or are free follow the cells. Overlapping faces of such points at the end of one
// linear step do not tell what several steps would lead to, so they may be ignored.
enum class Overlaps { cross, ignored };

// The information on the final place of a boundary point before the mesh has moved: the place
// itself; the line along which the point slips; nothing.
enum class KnownEnd : std::uint8_t { prescribed, on_line, unknown };

// A boundary crosses itself where faces cross, where faces overlap on a line, and where the
// boundary passes exactly through one of its own points or faces; the decision is exact. A touch in
// a point is no crossing. The two sides of a wall without thickness, whose faces have the same
// ends, do not cross either; but walls that have come to lie on each other face by face do cross,
// which shows where they separate: mesh is between them. Boundary faces are in the order of their
// loops, with the mesh on the left (see Boundary). Faces that follow each other lie close together,
// so half a list takes about half the space: boxes of list ranges exclude most pairs without any
// memory. The points are moved by `displacement` (not given: 0).
Crossing find_crossing(Span<const Index> boundary_point, Span<const Index> loop_start,
                       Points points, Points displacement = {},
                       Overlaps overlaps = Overlaps::cross) noexcept;
// Searches only among known places, ends [n_points]. Points that slip may be anywhere on their
// line. Faces with a point whose place is unknown are ignored, and so are pairs of a face along a
// line and a face of a wall that ends on this line.
Crossing find_known_crossing(Span<const Index> boundary_point, Span<const Index> loop_start,
                             Points points, Span<const KnownEnd> ends) noexcept;

}  // namespace harmorph
