// Refines a mesh: each side is divided in two, each triangle or quadrilateral in four.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <functional>
#include <iosfwd>

namespace cli {

// Writes the refined mesh as an SU2 file. on_boundary(marker, a, b) returns the place of the middle
// of a boundary face between two points.
void write_refined(std::ostream& out, const Mesh& mesh,
                   const std::function<Point(std::int32_t, Point, Point)>& on_boundary);

}  // namespace cli
