// Reads the nodes and elements of a Gmsh file.
#pragma once

#include "formats/element_mesh.hpp"

namespace cli {

// Reads mesh.file, and sets the kind of numbers of mesh.in_file.
Elements read_gmsh(Mesh& mesh);

}  // namespace cli
