// What a Gmsh file holds, between reading and the mesh: nodes and elements by their tags.
#pragma once

#include "mesh/mesh_file.hpp"

namespace cli {

struct GmshElementType {
    int number, dimension, corners, nodes;
};

struct GmshNode {
    std::int64_t tag;
    double x, y;
    std::size_t x_offset, y_offset;
};

struct GmshElement {  // a curve or a surface
    const GmshElementType* type;
    std::int32_t marker;        // of curves; -1: a cell
    std::size_t offset, first;  // in the file; of its nodes in element_nodes
};

struct GmshContent {
    std::vector<GmshNode> nodes;
    std::vector<GmshElement> elements;
    std::vector<std::int64_t> element_nodes;  // tags
};

// Reads mesh.file, and gives the mesh its markers and mesh.in_file its kind of numbers.
GmshContent read_gmsh_content(Mesh& mesh);

// Gives the mesh its points, cells and faces.
void build_gmsh_mesh(Mesh& mesh, const GmshContent& content);

}  // namespace cli
