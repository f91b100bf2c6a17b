// Reads the mesh of a CGNS file. This source is compiled by `make CGNS=1` only.
#pragma once

#ifdef HARMORPH_CGNS
#include "mesh/mesh_file.hpp"

namespace cli {

void read_cgns(Mesh& mesh);

}  // namespace cli
#endif
