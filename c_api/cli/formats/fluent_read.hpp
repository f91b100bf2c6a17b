// The nodes, faces and names of a Fluent mesh file, as its sections list them.
#pragma once

#include "mesh/mesh_file.hpp"

#include <array>
#include <map>

namespace cli {

struct FluentNode {
    std::int64_t number;                // counted from 1
    std::array<double, 3> x;            // in two dimensions, the last one is 0
    std::array<std::size_t, 3> offset;  // of each coordinate in the file
};

struct FluentFace {
    std::size_t first;  // its nodes are face_nodes[first] ... face_nodes[first + n - 1]
    std::int32_t n;
    std::int32_t cells[2];  // counted from 0; -1: none. In two dimensions the first one is on the
                            // right of the face.
    std::int64_t zone;
    bool is_interior;  // according to the type of the zone
    std::size_t offset;
};

struct FluentContent {
    int dimension = 2;
    std::vector<FluentNode> nodes;  // in the order of their numbers, which are 1, 2, ...
    std::vector<FluentFace> faces;
    std::vector<std::int32_t> face_nodes;  // counted from 0
    std::int32_t n_cells = 0;
    std::map<std::int64_t, std::string> names;  // of zones

    const std::int32_t* nodes_of(const FluentFace& face) const { return &face_nodes[face.first]; }
};

// Reads all sections of the file of the mesh and sets mesh.in_file.kind. Refuses nodes that do not
// exist, and more cells than the faces can have.
FluentContent read_fluent_content(Mesh& mesh);

}  // namespace cli
