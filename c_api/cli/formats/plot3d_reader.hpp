// Makes points, cells and sides of a mesh from the blocks of a PLOT3D grid; see plot3d.cpp.
#pragma once

#include "formats/format.hpp"
#include "formats/plot3d_layout.hpp"

namespace cli {

// mesh.file is the grid, in this layout.
void read_plot3d_blocks(Mesh& mesh, const Plot3dLayout& layout);

}  // namespace cli
