// Computes the constrained Delaunay triangulation of the points of the mesh: quads are split into
// triangles, then edges are flipped.
#pragma once

#include "base/arena.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// An edge of the triangulation, with the third points of the triangles on both sides; right is none
// on the boundary. The triangles (begin, end, left) and (end, begin, right) run counter-clockwise.
struct DelaunayEdge {
    Index begin, end, left, right;
};

// The method is that of Lawson (Software for C1 surface interpolation, in: Mathematical Software
// III, 1977). Consider an inner edge and its two triangles. If the third point of one triangle lies
// strictly inside the circle through the other triangle, the edge is flipped, that is, replaced by
// the other diagonal of the two triangles. Boundary edges are never flipped, so the domain does not
// change. A flip is always possible, because two such triangles form a strictly convex quad. The
// algorithm ends, because each flip lowers the surface (x, y, x^2 + y^2) over the mesh: no
// triangulation occurs twice, and there are finitely many. The proof needs exact decisions,
// see predicates.hpp.
//
// Points that a cut joins are one point. Edges of a periodic pair are boundary edges: a flip across
// them would be decided with translated coordinates, which have rounding errors. All cells of the
// triangulation are counter-clockwise triangles of representative points; there are no boundary
// faces.
struct Triangulation : Topology {
    Index flips = 0;

    // Takes arrays whose sizes depend on the counts of the mesh alone.
    void lay_out(Arena& arena, Mesh const& counts) noexcept;
    // Refuses a cell that has a corner without positive area.
    Status build(Topology const& given, Fault& fault) noexcept;

    // Calls visit(DelaunayEdge) for all edges, in the order of `edges`.
    template <class Visit>
    void for_each_edge(Visit visit) const noexcept;

private:
    Span<Index> corner_;  // [3 * triangles]
    // [3 * triangles] For the side opposite to each corner, the same edge as a side of the
    // neighbouring triangle, or none.
    Span<Index> across_;
    Span<Index> waiting_;  // [triangles] a stack
    Span<std::uint8_t> is_waiting_;

    static Size max_triangles(Mesh const& mesh) noexcept;
    Status split(Topology const& given, Fault& fault) noexcept;
    void add(Index a, Index b, Index c) noexcept;
    void find_neighbours() const noexcept;
    void flip_all() noexcept;
    bool is_delaunay(Index side) const noexcept;
    void flip(Index side) const noexcept;
};

// Returns the third point of the counter-clockwise triangle that has the side with this code (see
// Edges) between begin and end.
inline Index apex_of(Mesh const& triangles, Index begin, Index end, Index code) noexcept {
    Cell const cell = triangles.cell(cell_of_side(code));
    for (Index k = 0; k < 2; ++k) {
        if (cell.point[k] != begin && cell.point[k] != end) return cell.point[k];
    }
    return cell.point[2];
}

template <class Visit>
void Triangulation::for_each_edge(Visit visit) const noexcept {
    edges.for_each([&](Index edge, Index low, Index high) {
        Index const first = edges.first[edge].code, second = edges.second[edge];
        Index const apex = apex_of(mesh, low, high, first);
        Index const other = second < 0 ? none : apex_of(mesh, low, high, second);
        visit(runs_backwards(first) ? DelaunayEdge{high, low, apex, other}
                                    : DelaunayEdge{low, high, apex, other});
    });
}

}  // namespace harmorph
