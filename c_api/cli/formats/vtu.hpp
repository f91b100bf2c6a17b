// Writes VTU files (VTK XML, unstructured grid, in text), which ParaView reads.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct PointData {
    std::string name;
    std::size_t components;      // 1, or 3 for a vector
    std::vector<double> values;  // [points * components]
};

PointData displacement_data(const Field& displacement);  // vectors with z = 0

void write_vtu(std::ostream& out, const Mesh& mesh);

// Writes the cells of the mesh, with points at x, y and values at the points.
void write_vtu(std::ostream& out, const Mesh& mesh, const std::vector<double>& x,
               const std::vector<double>& y, const std::vector<PointData>& data);

}  // namespace cli
