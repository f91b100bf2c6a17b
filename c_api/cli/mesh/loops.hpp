// The edges of a mesh, chains of edges, and loops of the boundary.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace cli {

struct Edge {
    std::int32_t a, b;  // a < b
};

inline bool precedes(Edge one, Edge other) {
    return one.a != other.a ? one.a < other.a : one.b < other.b;
}

// Calls visit(from, to) for each side of the cells from begin on, before end, in the sense in which
// the cell runs.
template <class Visit>
void for_each_side(const Mesh& mesh, std::size_t begin, std::size_t end, const Visit& visit) {
    for (std::size_t cell = begin; cell < end; ++cell) {
        const std::int32_t* points = mesh.cell_points.data() + mesh.cell_start[cell];
        const std::int32_t n = mesh.cell_start[cell + 1] - mesh.cell_start[cell];
        for (std::int32_t i = 0; i < n; ++i) visit(points[i], points[i + 1 < n ? i + 1 : 0]);
    }
}

// Sorts edges and removes repeated ones.
void remove_repeats(std::vector<Edge>& edges);

// Returns each edge once, in order, without those for which visible() returns false.
std::vector<Edge> mesh_edges(const Mesh& mesh, const std::function<bool(Edge)>& visible);

// Returns chains of points that contain each edge once: a chain takes half the space of separate
// edges.
std::vector<std::vector<std::int32_t>> edge_chains(const std::vector<Edge>& edges,
                                                   std::int32_t n_points);

// Returns for each of the points one point at its place: the first one in an order along a
// direction to which hardly any cut is normal. Places may differ by the rounding that the library
// accepts in cuts (hm_mesh).
std::unordered_map<std::int32_t, std::int32_t> points_by_place(
    const Mesh& mesh, const std::vector<std::int32_t>& points);

// Takes and returns the two ends of each edge of a boundary. A cut that reaches the boundary
// divides a point in two, each at the end of an odd number of edges: the smaller number stands for
// both.
std::vector<std::int32_t> joined_ends(const Mesh& mesh, std::vector<std::int32_t> ends);

// Edges that are connected by their ends. Edges of a closed boundary form loops; edges of a part of
// a boundary may form open chains. Both are called loops here.
struct BoundaryLoops {
    std::int32_t count = 0;
    // The loop of each edge, from 0. Loops are in the order of their smallest points.
    std::vector<std::int32_t> of_edge;

    // ends: two points of each edge, between 0 and n_points - 1.
    BoundaryLoops(const std::vector<std::int32_t>& ends, std::int32_t n_points);
};

// Returns the loops of the boundary of a mesh; cuts are closed.
BoundaryLoops loops_of(const Mesh& mesh);

// Returns the box around each loop of the boundary of a mesh.
std::vector<Box> boxes_of_loops(const BoundaryLoops& loops, const Mesh& mesh);

// Returns the loop of the largest extent, which is around all others where there is one domain; -1
// without loops. The other loops are bodies.
std::int32_t outer_loop(const std::vector<Box>& boxes);

// Says how a movement changes which loops of the boundary lie inside each other, if it does: a body
// that is outside the domain, or inside another body, crosses nothing, and no mesh can have such a
// boundary. Returns an empty text otherwise.
std::string why_bodies_cannot_be_there(const Mesh& mesh, const Field& moved);

}  // namespace cli
