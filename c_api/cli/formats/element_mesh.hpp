// Nodes and elements as files list them, in two dimensions or one cell thick. Readers, such as
// those of Gmsh and VTK files, fill Elements, and build_mesh() makes the mesh.
#pragma once

#include "mesh/space_mesh.hpp"

#include <utility>

namespace cli {

// The nodes of an element are the corners and, in second order, middles of edges, faces and the
// cell.
struct ElementShape {
    int dimension, corners, nodes;
    const char* middles;  // the nodes after the corners: "01 12 012" are the middles of two edges
                          // and of the triangle, each named by its corners

    constexpr ElementShape(int dimension_, int corners_, const char* middles_ = "")
        : dimension(dimension_), corners(corners_), nodes(corners_), middles(middles_) {
        for (const char* c = middles; *c; ++c) nodes += c == middles || c[-1] == ' ' ? 1 : 0;
    }
};

struct Elements {
    struct Element {
        ElementShape shape;
        std::int32_t group;         // of the boundary: a place in `groups`; -1: none
        std::size_t offset, first;  // the place in the file; the place of its nodes in `nodes`
    };
    SpacePoints points;
    std::vector<Element> elements;
    std::vector<std::int32_t> nodes;               // the points of all elements
    std::vector<std::vector<std::string>> groups;  // the names of each group

    void add(const ElementShape& shape, std::int32_t group, std::size_t offset) {
        elements.push_back({shape, group, offset, nodes.size()});
    }
};

// Elements of the largest dimension are cells; those of one dimension less are the boundary, and
// others are ignored. Triangles, quadrilaterals and polygons must lie in one plane; prisms,
// hexahedra, pyramids and tetrahedra form a mesh one cell thick. An edge of several groups gets the
// marker "a+b", and the mesh knows it by both names. Edges of the boundary in no group get the
// markers boundary1, boundary2, ...
void build_mesh(Mesh& mesh, const Elements& elements);

}  // namespace cli
