// Finds out whether the boundary crosses itself, or one body another one. Positive cell areas do
// not exclude that.
#pragma once

#include "base/vec2.hpp"
#include "mesh/boundary_faces.hpp"

namespace harmorph {

// Two faces, each given by the points where it begins and ends.
struct Crossing {
    bool found = false;
    Index first[2] = {none, none};
    Index second[2] = {none, none};
};

// Tells for two points whether the digits of their coordinates cannot tell the points apart,
// neither before a movement nor after it. So are points on the two sides of a wall without
// thickness, where a file has rounded both sides in different ways.
bool stay_at_one_place(Vec2 a, Vec2 b, Vec2 a_moved, Vec2 b_moved) noexcept;

// Points that slip or are free follow the cells. Overlapping faces of such points at the end of one
// linear step do not tell what several steps would lead to, so they may be ignored.
enum class Overlaps { cross, ignored };

// The information on the final place of a boundary point before the mesh has moved: the place
// itself; the line along which the point slips; nothing.
enum class KnownEnd : std::uint8_t { prescribed, on_line, unknown };

// A boundary crosses where faces do, where faces lie on each other, and where it passes exactly
// through a point of its own or a face; decided exactly. To touch in a point is not to cross, nor
// are the two sides of a wall without thickness, whose faces have the same ends: of walls that came
// to lie on each other face by face, mesh is between them where they part. Boundary faces in the
// order of their loops, the mesh on the left (see Boundary). Faces that follow each other lie close
// together, so halving the list halves the place it takes: boxes of list ranges prune the pairs,
// without any memory. The two sides of a sliding interface may cross each other.
Crossing find_crossing(BoundaryFaces const& faces, Points points) noexcept;
// The same for points + displacement (not given: 0). Two faces that cross each other at `points`
// already do not count, as the movement is not the reason. Points that stay at one place count as
// one place.
Crossing find_crossing(BoundaryFaces const& faces, Points points, Points displacement,
                       Overlaps overlaps = Overlaps::cross) noexcept;
// The same for the points `now`, where two faces that cross each other at `start` do not count.
Crossing find_new_crossing(BoundaryFaces const& faces, Points start, Points now) noexcept;
// The same with regard only to points whose places at the end are known, ends [n_points]. Points
// that slip may stand anywhere on their line; faces of points of which nothing is known are passed
// over, and so are pairs of a face along a line and a face of a wall that ends on this line.
Crossing find_known_crossing(BoundaryFaces const& faces, Points start, Points points,
                             Span<const KnownEnd> ends) noexcept;

}  // namespace harmorph
