// Finds places where the boundary crosses itself, or where one body crosses another. Positive cell
// areas do not exclude such places.
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

// Tells whether the distance of two points is within the rounding of their coordinates, both before
// a movement and after it. Equal places occur for points on the two sides of a wall without
// thickness if a file has rounded both sides differently.
bool stay_at_one_place(Vec2 a, Vec2 b, Vec2 a_moved, Vec2 b_moved) noexcept;

// Points that slip or are free follow the cells. If faces of such points overlap at the end of one
// linear step, they need not overlap after several steps, so these overlaps may be ignored.
enum class Overlaps { cross, ignored };

// What is known of the final place of a boundary point before the mesh has moved: the place itself,
// the line along which the point slips, or nothing.
enum class KnownEnd : std::uint8_t { prescribed, on_line, unknown };

// Finds a crossing of the boundary, decided without rounding: two faces cross, faces lie on each
// other, or the boundary passes through a boundary point or a face. Loops that only touch in a
// point do not cross. Two faces with the same ends are the two sides of a wall without thickness
// and do not cross, unless mesh lies between the walls where they separate. The mesh is on the left
// of the faces (see Boundary). Boxes of ranges of faces exclude most pairs, without any memory. The
// two sides of a sliding interface may cross each other.
Crossing find_crossing(BoundaryFaces const& faces, Points points) noexcept;
// The same for points + displacement, which is 0 if it is not given. Two faces that cross each
// other already at `points` are ignored, because the movement is not the reason. Two points for
// which stay_at_one_place() holds are one point.
Crossing find_crossing(BoundaryFaces const& faces, Points points, Points displacement,
                       Overlaps overlaps = Overlaps::cross) noexcept;
// The same for the points `now`. Two faces that cross each other already at `start` are ignored.
Crossing find_new_crossing(BoundaryFaces const& faces, Points start, Points now) noexcept;
// The same for points whose final places are known, see ends [n_points]. Points that slip may be
// anywhere on their line. Faces with a point of which nothing is known are ignored, and so are
// pairs of a face along a line and a face of a wall that ends on this line.
Crossing find_known_crossing(BoundaryFaces const& faces, Points start, Points points,
                             Span<const KnownEnd> ends) noexcept;

// The step along a displacement at which the boundary first touches itself.
struct Touch {
    Real step = infinity;
    Index point = none;            // The point that touches a face.
    Index face[2] = {none, none};  // The points where this face begins and ends.
};

// Returns the smallest s with 0 < s < limit at which a point of the boundary lies on a face to
// which it does not belong, with all points at points + s displacement. The first touch of two
// faces is one of an end of the one with the other, so no other pairs are examined. The area
// between a point and a face is a quadratic function of s, whose roots are exact except for
// rounding. Faces that touch at s = 0 count when they touch again. If they cross each other at
// once, so that the boundary crosses itself at s = 1, but not at s = 0, without a touch on the way,
// the step is 0. The two sides of a sliding interface may touch, as may a point and a face at whose
// end the point stays (stay_at_one_place).
// Boundary faces are those of find_crossing(); boxes of places and of displacements of list ranges
// tell when two ranges can meet, without any memory.
Touch first_touch(BoundaryFaces const& faces, Points points, Points displacement,
                  Real limit) noexcept;

}  // namespace harmorph
