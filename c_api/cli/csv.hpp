// Tables of point values with commas: point (as numbered in the mesh file), x, y, and the named columns.
#pragma once

#include "mesh.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Column {
    std::string name;
    std::vector<double> values; // one for each point
};

void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<Column>& columns);

} // namespace cli
