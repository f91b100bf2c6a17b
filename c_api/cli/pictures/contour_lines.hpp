// Lines on which a function has a given value.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <vector>

namespace cli {

struct ContourLine {
    std::int32_t multiple;  // the value of the function on this line, divided by the step
    std::vector<Point> points;
};

// Returns the lines of all multiples of the step in the triangles that the window shows. Each line
// has its full length; a closed line ends with its first point. The function has the given values
// at the mesh points, and is linear on each triangle.
std::vector<ContourLine> contour_lines(const Mesh& mesh, const std::vector<double>& values,
                                       double step, const Box& window);

}  // namespace cli
