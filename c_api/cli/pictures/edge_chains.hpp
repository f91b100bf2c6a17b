// The edges of a mesh, strung together: a chain of points takes half the space of separate edges.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <functional>
#include <vector>

namespace cli {

struct Edge {
    std::int32_t a, b;  // a < b
};

// Each edge once; those for which visible() says no are left out.
std::vector<Edge> mesh_edges(const Mesh& mesh, const std::function<bool(Edge)>& visible);

// Chains of points that run over each edge once.
std::vector<std::vector<std::int32_t>> edge_chains(const std::vector<Edge>& edges,
                                                   std::int32_t n_points);

}  // namespace cli
