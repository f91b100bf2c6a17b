// Does the boundary cross itself, or one body another? Positive cell areas do not tell.
#pragma once

#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// Two faces: the points where they begin and end.
struct Crossing {
    bool found = false;
    Index first[2] = {none, none};
    Index second[2] = {none, none};
};

// Points that slide or are free go where cells take them: that their faces would lie on each other
// at the end of one linear step says nothing about the way there in several.
enum class Overlaps { cross, ignored };

// What is known of the end of a boundary point before the mesh has moved: all; the line that it
// slides along; nothing.
enum class EndOf : std::uint8_t { prescribed, on_line, unknown };

// A boundary crosses where faces do, where faces lie on each other, and where it passes exactly
// through a point of its own or a face; decided exactly. To touch in a point is not to cross, nor
// are the two sides of a wall without thickness, whose faces have the same ends: of walls that came
// to lie on each other face by face, mesh is between them where they part. Boundary faces in the
// order of their loops, the mesh on the left (see Boundary). Faces that follow each other lie close
// together, so halving the list halves the place it takes: boxes of list ranges prune the pairs,
// without any memory. The points are taken where `displacement` (not given: 0) puts them.
Crossing find_crossing(Span<const Index> boundary_point, Span<const Index> loop_start,
                       Points points, Points displacement = {},
                       Overlaps overlaps = Overlaps::cross) noexcept;
// Of what is known alone, ends [n_points]. Points that slide may stand anywhere on their line;
// faces of points of which nothing is known are passed over, and so are pairs of a face along a
// line and a face of a wall that ends on this line.
Crossing find_known_crossing(Span<const Index> boundary_point, Span<const Index> loop_start,
                             Points points, Span<const EndOf> ends) noexcept;

}  // namespace harmorph
