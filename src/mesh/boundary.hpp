// The boundary of the mesh as directed faces, the mesh on their left, in order along closed loops.
#pragma once

#include "base/arena.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

struct Boundary {
    Index count = 0;  // faces
    Index n_loops = 0;
    Span<Index> point;  // [count] where each face begins; the end is the beginning of the next face
                        // of the loop
    Span<Index> marker;      // [count]
    Span<Index> condition;   // [count] number of the condition that holds there, or none: see
                             // boundary/conditions
    Span<Index> loop_start;  // [n_loops + 1]

    Span<Index> given_begin, given_end,
        given_marker;  // [max_faces] as marked; order() directs them
    Span<Index> head;  // [n_points] working space of order()
    Span<Index> next;  // [max_faces]

    // As many faces as the caller gives, segments of lists counted generously, and all sides of
    // blocks.
    static Size max_faces(Mesh const& mesh) noexcept;
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;

    // Finds the edge of every face and list segment and notes the marker there (edges.second).
    // Cells need no orientation yet.
    Status mark(Topology& topology, Fault& fault) noexcept;
    // Refuses a boundary edge without a marker, and puts the faces in order.
    Status order(Topology const& topology, Fault& fault) noexcept;

    // Pieces: runs of faces for which is_on(face) holds. visit(piece, point) for their points in
    // order, then close(piece, is_loop); the first point of a whole loop is not repeated. Returns
    // how many pieces there are.
    template <class IsOn, class Visit, class Close>
    Index for_each_piece(IsOn is_on, Visit visit, Close close) const noexcept;

    // The next face of the same loop.
    Index after(Index face, Index loop) const noexcept {
        return face + 1 == loop_start[loop + 1] ? loop_start[loop] : face + 1;
    }
};

template <class IsOn, class Visit, class Close>
Index Boundary::for_each_piece(IsOn is_on, Visit visit, Close close) const noexcept {
    Index piece = 0;
    for (Index loop = 0; loop < n_loops; ++loop) {
        Index const begin = loop_start[loop], n = loop_start[loop + 1] - begin;
        Index gap = none;  // a face that is not on: behind it a piece may begin
        for (Index k = 0; k < n && gap == none; ++k) {
            if (!is_on(begin + k)) gap = k;
        }
        bool inside = false;
        for (Index k = 0; k < n; ++k) {
            Index const face = begin + (gap == none ? k : (gap + 1 + k) % n);
            bool const on = is_on(face);
            if (on || inside)
                visit(piece, point[face]);  // where a face begins, or the last of a piece ends
            if (!on && inside) close(piece++, false);
            inside = on;
        }
        if (inside) close(piece++, true);
    }
    return piece;
}

// Joins the points of a cut: edges without marker whose end points coincide bit by bit in pairs.
// `points` [n_points] is working space. Returns how many points were joined to another.
Index join_cuts(Topology& topology, Span<Index> points) noexcept;

}  // namespace harmorph
