// Tables of point values with commas: point (as numbered in the mesh file), x, y, value.
#pragma once

#include "mesh.hpp"

#include <iosfwd>
#include <vector>

namespace cli {

void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<double>& values);

} // namespace cli
