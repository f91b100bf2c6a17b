// The columns of a table that tell which points of a mesh its rows are. This is the only place that
// knows how programs spell these columns.
//
// Large and small letters, blanks and the signs between words do not count, and a unit behind the
// name, such as [m], is cut off.
//
//     numbers      PointID (SU2), Point ID and PointIds (ParaView), point (harmorph), Point_Index,
//                  Global_Index (SU2), GlobalPointIds and vtkOriginalPointIds (VTK)
//     coordinates  x; x_coord, x-coordinate (SU2, Fluent), CoordinateX (CGNS), Position_X;
//                  Points_0, Points:0, Coordinates[0] (ParaView), X:0: vectors with components
//                  from 0
//
// Numbers that some programs count from 1 (nodenumber, GlobalNodeId) are not known: rows with such
// numbers are found by their coordinates.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cli {

struct PointColumns {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t number = none;  // points counted from 0, in the order of the mesh file
    std::size_t place[3] = {none, none, none};  // x, y, z

    bool has_numbers() const { return number != none; }
    bool has_places() const { return place[0] != none && place[1] != none; }
};

// Returns the places of these columns in `names`. Where several columns have numbers, those of the
// whole mesh (vtkOriginalPointIds) come before those of a part of the mesh (Point ID). Coordinates
// come from columns that are spelled alike, those of the first line above first.
PointColumns find_point_columns(const std::vector<std::string>& names);

// Tells whether a column is no result but says where a row is: a number of points however spelled,
// or one of the coordinates, or the length of their vector (ParaView's Points_Magnitude).
bool says_where(const std::vector<std::string>& names, std::size_t column);

}  // namespace cli
