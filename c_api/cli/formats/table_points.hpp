// The points of a mesh to which the rows of a table belong.
#pragma once

#include "formats/point_table.hpp"

namespace cli {

// Returns whether the rows are the points of the mesh's own file, which has three coordinates.
bool has_points_of_file(const PointTable& table, const Mesh& mesh);

// The larger of width and height. Rounding makes places differ by smallest_reach times this.
double extent_of(const Mesh& mesh);
constexpr double smallest_reach = 1e-12;

// What becomes of rows whose points of the file are one point of the mesh: those of both planes of
// a mesh one cell thick, and those that a cut or the sides of blocks join.
enum class JoinedRows { refused, taken };

// Returns the mesh point of each row: by its number, or else by its coordinates, which are compared
// with the mesh if the table has both. Where the digits of a table tell neighbouring points apart,
// they do; where they do not, a row without a number is the point of its place in the table, if
// that point has these digits. Refuses rows whose coordinates are not those of a point of the mesh,
// points that occur twice, and values at all points in space of a mesh that is one cell thick.
// Where a table has neither, the rows must be all points of the mesh in their order: such a table
// is refused, with the list of its columns, unless `in_order` is set or the kind of file says so
// (fields of OpenFOAM).
std::vector<std::int32_t> points_of(const PointTable& table, const Mesh& mesh, bool in_order,
                                    JoinedRows joined = JoinedRows::refused);

}  // namespace cli
