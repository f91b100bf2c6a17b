// The unknowns, and which of them share a cell: this is the pattern of the matrix, and the graph
// that the dissection cuts. A point has one unknown (a real or a complex number), or two if slip
// lines couple movements along x and y: these are the lines 2 * point and 2 * point + 1 of function
// values. A point that slips has only the first, along the tangent.
// tests/boundary/test_conditions.cpp covers this file.
#pragma once

#include "boundary/conditions.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Calls visit(a, b) for two points of one cell, once for each edge and for each diagonal of a quad.
// A periodic pair may show the same two points twice.
template <class Visit>
void for_each_pair(Topology const& topology, Visit visit) noexcept {
    Span<const Index> const representative = topology.representative;
    topology.edges.for_each(
        [&](Index, Index low, Index high) { visit(representative[low], representative[high]); });
    topology.mesh.for_each_cell([&](Index, Cell const& cell) {
        if (cell.n != 4) return;
        visit(representative[cell.point[0]], representative[cell.point[2]]);
        visit(representative[cell.point[1]], representative[cell.point[3]]);
    });
}

struct Graph {
    Index n = 0;           // The number of unknowns.
    Index components = 1;  // The number of lines of a point.
    Index couplings = 0;   // The number of pairs of an unknown and a line of a point on the wall.
    Index fixed = 0;       // The number of pairs of an unknown and a line whose value is 0.
    Span<Index> line;      // [n] The line of each unknown, increasing.
    // [components * n_points] The unknown of each line, or none. Joined points have the same
    // unknowns.
    Span<Index> unknown;
    Span<Offset> start;  // [n + 1]
    // The neighbours of each unknown. The end of the array has the couplings and the fixed pairs,
    // each as unknown and line.
    Span<Index> neighbour;
    // [n] The value is 1 if the unknown shares a cell with a point on the wall.
    Span<std::uint8_t> beside_curve;

    Index point(Index u) const noexcept { return components == 1 ? line[u] : line[u] / components; }

    void lay_out(Arena& arena, Mesh const& mesh, Index n_components) noexcept;
    void build(Topology const& topology, Span<const PointKind> kinds) noexcept;
    // Returns the first mesh point of a connected region that is next to no known value, in which
    // constants would be solutions too; or none. Only free boundaries leave such regions. queue and
    // reached [n] are working space.
    Index first_floating(Topology const& topology, Span<const PointKind> kinds, Span<Index> queue,
                         Span<std::uint8_t> reached) const noexcept;
    // Calls visit(unknown, line) for every coupling and every fixed pair.
    template <class Visit>
    void for_each_known(Visit visit) const noexcept {
        Size const n_known = static_cast<Size>(Offset{couplings} + fixed);
        Span<const Index> const pairs = neighbour.from(neighbour.size() - 2 * n_known, 2 * n_known);
        for (Size k = 0; k < n_known; ++k) visit(pairs[2 * k], pairs[2 * k + 1]);
    }
    Span<const Index> neighbours(Index u) const noexcept {
        return neighbour.from(start[u], start[u + 1] - start[u]);
    }
    // Prefetches the neighbours of the unknowns that come next in a queue, because searches wait
    // mostly for memory. The function is inlined, because gcc removes calls of functions that only
    // prefetch, as if they had no effect.
    __attribute__((always_inline)) void prefetch_neighbours(Span<const Index> queue, Index read,
                                                            Index filled) const noexcept {
        constexpr Index ahead = 8;
        if (read + 2 * ahead < filled) __builtin_prefetch(&start[queue[read + 2 * ahead]]);
        if (read + ahead < filled) __builtin_prefetch(&neighbour[start[queue[read + ahead]]]);
    }

private:
    template <Index n_components>
    void connect(Topology const& topology, Span<const PointKind> kinds) noexcept;
};

// The advancing front: the order of the unknowns in which layers round the boundaries reach them.
struct LayerWork {
    Span<std::uint8_t> in_quad;  // [n] The value is 1 if the unknown belongs to a corner of a quad.
    Span<std::uint8_t> reached;  // [n] The value is 1 if the front has reached the unknown.

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
};

// Fills order [n] with the unknowns, by breadth-first search from those that share a cell with a
// point of known value or are on a free boundary. The front passes through regions of quads first,
// and only then through the triangles, so that the agglomeration merges boundary layers normal to
// the wall before it merges other cells.
void order_by_layers(Topology const& topology, Span<const PointKind> kinds, Graph const& graph,
                     LayerWork const& work, Span<Index> order) noexcept;

}  // namespace harmorph
