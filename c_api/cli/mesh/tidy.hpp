// Steps that complete a mesh of any format after it has been read.
#pragma once

#include "mesh/mesh_file.hpp"

namespace cli {

// Refuses cells and faces with points that do not exist.
void check_points(const Mesh& mesh);

// Removes faces between two cells, which belong to no boundary. `remark`: reports them.
void drop_interior_faces(Mesh& mesh, bool remark);

// Joins faces with the same two points. A face with the markers "a" and "b" gets the
// marker "a+b", to which mesh.groups assigns both names.
void join_double_faces(Mesh& mesh);

// Removes markers without faces.
void drop_empty_markers(Mesh& mesh);

// Names boundary edges without a marker NAME1, NAME2, ..., loop by loop. Edges in pairs at equal
// coordinates are cuts, and get no marker. For formats in which boundaries may have no names.
void name_open_boundary(Mesh& mesh, const std::string& name);

}  // namespace cli
