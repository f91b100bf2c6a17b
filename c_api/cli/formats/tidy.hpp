// What is done with a mesh of any format once it has been read.
#pragma once

#include "mesh/mesh_file.hpp"

namespace cli {

// Refuses points of cells and faces that do not exist.
void check_points(const Mesh& mesh);

// Faces between two cells belong to no boundary: they are left out, and a remark may say so.
void drop_interior_faces(Mesh& mesh, bool remark);

// Faces that stand several times become one: with several markers, "a" and "b", it gets the marker
// "a+b", and mesh.groups says that both names belong to it.
void join_double_faces(Mesh& mesh);

// Leaves out markers without faces.
void drop_empty_markers(Mesh& mesh);

// Gives boundary edges that have no marker one: a loop of them is named NAME1, NAME2, ... Edges in
// pairs at equal coordinates are cuts, and get none. For files that need not name their boundaries.
void name_open_boundary(Mesh& mesh, const std::string& name);

}  // namespace cli
