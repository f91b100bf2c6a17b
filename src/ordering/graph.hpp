// The unknowns and which of them share a cell: the pattern of the matrix, and what the dissection
// cuts. A point has one unknown (a real or a complex number), or, where movements along x and y are
// coupled by slip lines, two: lines 2 * point and 2 * point + 1 of function values. One that slips
// has only the first, along its tangent.
#pragma once

#include "boundary/conditions.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Two points of one cell: an edge, or the diagonal of a quad. visit(a, b) for each edge once and
// for each cell's diagonals. A periodic pair may show the same two points twice.
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
    Index n = 0;           // unknowns
    Index components = 1;  // lines of a point
    Index couplings = 0;   // pairs of an unknown and a line of a point on the wall
    Index fixed = 0;       // pairs of an unknown and a line whose value is 0
    Span<Index> line;      // [n] of each unknown, increasing
    Span<Index>
        unknown;  // [components * n_points] unknown of each line, or none; of joined points too
    Span<Offset> start;  // [n + 1]
    Span<Index>
        neighbour;  // both directions; at the array's end couplings and fixed pairs: unknown, line
    Span<std::uint8_t> beside_curve;  // [n] 1: shares a cell with a point on the wall

    Index point(Index u) const noexcept { return components == 1 ? line[u] : line[u] / components; }

    void lay_out(Arena& arena, Mesh const& mesh, Index n_components) noexcept;
    void build(Topology const& topology, Span<const PointKind> kinds) noexcept;
    // First mesh point of a part that is next to no known value, where constants would be solutions
    // too; or none. Only free boundaries leave such parts. queue, reached [n]: working space.
    Index first_floating(Topology const& topology, Span<const PointKind> kinds, Span<Index> queue,
                         Span<std::uint8_t> reached) const noexcept;
    // visit(unknown, line) for every coupling and every fixed pair.
    template <class Visit>
    void for_each_known(Visit visit) const noexcept {
        Size const n_known = static_cast<Size>(Offset{couplings} + fixed);
        Span<const Index> const pairs = neighbour.from(neighbour.size() - 2 * n_known, 2 * n_known);
        for (Size k = 0; k < n_known; ++k) visit(pairs[2 * k], pairs[2 * k + 1]);
    }
    Span<const Index> of(Index u) const noexcept {
        return neighbour.from(start[u], start[u + 1] - start[u]);
    }
    // Searches wait mostly for memory: prefetches the neighbours of the unknowns that come next in
    // a queue. Inlined, because gcc removes calls of functions that only prefetch, as if they had
    // no effect.
    __attribute__((always_inline)) void expect(Span<const Index> queue, Index read,
                                               Index filled) const noexcept {
        constexpr Index ahead = 8;
        if (read + 2 * ahead < filled) __builtin_prefetch(&start[queue[read + 2 * ahead]]);
        if (read + ahead < filled) __builtin_prefetch(&neighbour[start[queue[read + ahead]]]);
    }

private:
    template <Index n_components>
    void connect(Topology const& topology, Span<const PointKind> kinds) noexcept;
};

}  // namespace harmorph
