// The edges of a mesh in chains: a chain of points takes half the space of separate edges.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <functional>
#include <vector>

namespace cli {

struct Edge {
    std::int32_t a, b;  // a < b
};

// Returns each edge once, without those for which visible() returns false.
std::vector<Edge> mesh_edges(const Mesh& mesh, const std::function<bool(Edge)>& visible);

// Returns chains of points that run over each edge once.
std::vector<std::vector<std::int32_t>> edge_chains(const std::vector<Edge>& edges,
                                                   std::int32_t n_points);

}  // namespace cli
