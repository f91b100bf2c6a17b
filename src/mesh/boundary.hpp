// The boundary of the mesh consists of directed faces in order along closed loops, with the mesh on
// their left.
#pragma once

#include "base/arena.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

struct Boundary {
    Index count = 0;  // faces
    Index n_loops = 0;
    // [count] The point at which each face begins; the face ends where the next face of the loop
    // begins.
    Span<Index> point;
    Span<Index> marker;  // [count]
    // [count] The number of the condition that holds on each face, or none; see
    // boundary/conditions.
    Span<Index> condition;
    Span<Index> loop_start;  // [n_loops + 1]

    // [max_faces] The faces that mark() has found; order() directs them.
    Span<Index> given_begin, given_end, given_marker;
    Span<Index> head;  // [n_points] working space of order()
    Span<Index> next;  // [max_faces] working space of order()

    // Returns an upper bound of the number of faces: those that the caller gives, the segments of
    // point lists, and the edges along all sides of blocks.
    static Size max_faces(Mesh const& mesh) noexcept;
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;

    // Finds the edge of every face and list segment and writes the number of the face to
    // edges.second. The cells need not be oriented yet.
    Status mark(Topology& topology, Fault& fault) noexcept;
    // Refuses a boundary edge without a marker, and puts the faces in order.
    Status order(Topology const& topology, Fault& fault) noexcept;

    // A chain is a longest sequence of connected faces for which is_on(face) holds. Calls
    // visit(chain, point) for the points of each chain in order, then close(chain, is_loop). The
    // first point of a whole loop is not repeated. Returns the number of chains.
    template <class IsOn, class Visit, class Close>
    Index for_each_chain(IsOn is_on, Visit visit, Close close) const noexcept;

    // Returns whether any face has the marker.
    bool has_marker(Index wanted) const noexcept {
        return contains<Index>(marker.first(count), wanted);
    }
    // Returns the next face of the same loop.
    Index after(Index face, Index loop) const noexcept {
        return face + 1 == loop_start[loop + 1] ? loop_start[loop] : face + 1;
    }
};

template <class IsOn, class Visit, class Close>
Index Boundary::for_each_chain(IsOn is_on, Visit visit, Close close) const noexcept {
    Index chain = 0;
    for (Index loop = 0; loop < n_loops; ++loop) {
        Index const begin = loop_start[loop], n = loop_start[loop + 1] - begin;
        Index gap = none;  // a face outside all chains; a chain may begin after it
        for (Index k = 0; k < n && gap == none; ++k) {
            if (!is_on(begin + k)) gap = k;
        }
        bool inside = false;
        for (Index k = 0; k < n; ++k) {
            Index const face = begin + (gap == none ? k : (gap + 1 + k) % n);
            bool const on = is_on(face);
            // A chain consists of the first points of its faces and the last point of its last
            // face.
            if (on || inside) visit(chain, point[face]);
            if (!on && inside) close(chain++, false);
            inside = on;
        }
        if (inside) close(chain++, true);
    }
    return chain;
}

// Joins the points of a cut: ends of edges without a marker are joined if no coordinate differs by
// more than the tolerance. `points` [n_points] is working space. Returns the number of points that
// were joined to another point.
Index join_cuts(Topology& topology, Span<Index> points, Real tolerance) noexcept;
// Returns the distance up to which points of a cut may differ by rounding.
Real rounding_of_cuts(Topology const& topology) noexcept;

// Joins cuts as far as edges without a marker remain: first points with equal coordinates, then
// points that differ by rounding, so that cuts without a gap never depend on the tolerance.
// rebuild() finds and marks the edges between representatives again.
template <class Rebuild>
Status join_cuts(Topology& topology, Boundary& boundary, Fault& fault,
                 Rebuild const& rebuild) noexcept {
    if (boundary.count == topology.edges.n_boundary) return Status::ok;
    Span<Index> const points = boundary.head.first(topology.mesh.n_points);
    Real const tolerances[2] = {0, rounding_of_cuts(topology)};
    for (Real const tolerance : tolerances) {
        if (boundary.count == topology.edges.n_boundary) break;
        if (join_cuts(topology, points, tolerance) == 0) continue;
        rebuild();
        HARMORPH_TRY(fault.status);
    }
    return Status::ok;
}

}  // namespace harmorph
