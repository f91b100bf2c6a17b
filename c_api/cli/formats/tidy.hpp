// What is done with a mesh of any format once it has been read.
#pragma once

#include "mesh/mesh_file.hpp"

namespace cli {

// Refuses points of cells and faces that do not exist.
void check_points(const Mesh& mesh);

// Faces between two cells belong to no boundary: they are left out, and a remark may say so.
void drop_interior_faces(Mesh& mesh, bool remark);

// Leaves out markers without faces.
void drop_empty_markers(Mesh& mesh);

// Gives boundary edges that have no marker one: a loop of them is named NAME1, NAME2, ... For
// formats without boundaries.
void name_open_boundary(Mesh& mesh, const std::string& name);

}  // namespace cli
