// The constrained Delaunay triangulation of the points of the mesh: quads are split, then edges
// flipped.
#pragma once

#include "base/arena.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// An edge of the triangulation with the third points of the triangles at its sides; right is none
// on the boundary. The triangles begin, end, left and end, begin, right run counter-clockwise.
struct DelaunayEdge {
    Index begin, end, left, right;
};

// Lawson flips (Software for C1 surface interpolation, in: Mathematical Software III, 1977): an
// inner edge whose opposite point lies strictly inside the circle through its other triangle is
// replaced by the other diagonal of the two. Boundary edges stay, so the domain does. No flip can
// fail: such two triangles form a strictly convex quad. The algorithm ends: each flip lowers the
// surface of (x, y, x^2 + y^2) over the mesh, so no triangulation occurs twice, and there are
// finitely many; this needs exact decisions, see predicates.hpp. Points joined by a cut are one
// point. Edges of a periodic pair are boundary: a flip across would be decided with translated
// coordinates, which carry rounding errors. The cells are triangles, all counter-clockwise, over
// the representatives of the points, without boundary faces.
struct Triangulation : Topology {
    Index flips = 0;

    // Sizes from the counts alone.
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
    // Refuses a cell that has a corner without positive area.
    Status build(Topology const& of, Fault& fault) noexcept;

    // visit(DelaunayEdge), in the order of `edges`.
    template <class Visit>
    void for_each_edge(Visit visit) const noexcept;

private:
    Span<Index> corner_;  // [3 * triangles]
    Span<Index>
        across_;  // [3 * triangles] the neighbour's side at the side opposite to a corner, or none
    Span<Index> waiting_;  // [triangles] a stack
    Span<std::uint8_t> is_waiting_;

    static Size max_triangles(Mesh const& mesh) noexcept;
    Status split(Topology const& of, Fault& fault) noexcept;
    void add(Index a, Index b, Index c) noexcept;
    void find_neighbours() const noexcept;
    void flip_all() noexcept;
    bool is_delaunay(Index side) const noexcept;
    void flip(Index side) const noexcept;
};

// The point of a counter-clockwise triangle that is not on the side with this code (see Edges).
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
