// The mesh of a CGNS file. Only in programs made with `make CGNS=1`.
#pragma once

#ifdef HARMORPH_CGNS
#include "mesh/mesh_file.hpp"

namespace cli {

void read_cgns(Mesh& mesh);

}  // namespace cli
#endif
