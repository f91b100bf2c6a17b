// SU2 mesh files (https://su2code.github.io/docs_v7/Mesh-File): two dimensions, one zone, triangles and quadrilaterals.
#pragma once

#include "mesh.hpp"

#include <iosfwd>
#include <string>

namespace cli {

Mesh read_su2(const std::string& path);

// The mesh's file as it is, except for the numbers of coordinates whose bits changed.
void write_su2(std::ostream& out, const Mesh& mesh, const double* x, const double* y);

} // namespace cli
