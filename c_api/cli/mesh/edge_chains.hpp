// The edges of a mesh, and chains of edges: a chain takes half the space of separate edges.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <functional>
#include <vector>

namespace cli {

struct Edge {
    std::int32_t a, b;  // a < b
};

inline bool precedes(Edge one, Edge other) {
    return one.a != other.a ? one.a < other.a : one.b < other.b;
}

// Sorts edges and removes repeated ones.
void remove_repeats(std::vector<Edge>& edges);

// Returns each edge once, in order, without those for which visible() returns false.
std::vector<Edge> mesh_edges(const Mesh& mesh, const std::function<bool(Edge)>& visible);

// Returns chains of points that contain each edge once.
std::vector<std::vector<std::int32_t>> edge_chains(const std::vector<Edge>& edges,
                                                   std::int32_t n_points);

}  // namespace cli
