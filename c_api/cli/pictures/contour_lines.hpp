// Lines on which a function has a given value.
#pragma once

#include "mesh/mesh_file.hpp"
#include "basics/geometry.hpp"

#include <vector>

namespace cli {

struct ContourLine {
    std::int32_t multiple;  // of the step: the function's value on this line
    std::vector<Point> points;
};

// The lines of all multiples of the step in the triangles that the window shows, each as long as it
// goes; a closed line has its first point again at the end. values: at the mesh's points, linear on
// each triangle.
std::vector<ContourLine> contour_lines(const Mesh& mesh, const std::vector<double>& values,
                                       double step, const Box& window);

}  // namespace cli
