// Finds the edges of the mesh, each with the cells on both sides.
#pragma once

#include "base/arena.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// Edges are stored with the smaller of their two points, in the order of the larger one. A side is
// an edge seen from one of its cells.
struct Edges {
    // In `second`, -1 marks a boundary edge without a face; -2 - number stands for that face.
    static constexpr Index unmarked = -1;

    struct Side {
        Index end;   // the larger point
        Index code;  // 2 * cell, + 1 if the cell runs from the larger point to the smaller one
    };

    Span<Index> start;     // [n_points + 1]
    Span<Side> first;      // [count]
    Span<Index> second;    // [count] code of the other cell, or negative on the boundary
    Index n_boundary = 0;  // the number of edges with a cell on one side only
    bool agree = false;    // the two cells of every inner edge run along it in opposite directions

    // Takes arrays for the largest possible number of edges.
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
    // representative [n_points] is the point that stands for each point; if the array is empty,
    // each point stands for itself. Refuses an edge of more than two cells.
    Status build(Mesh const& mesh, Span<const Index> representative, Fault& fault) noexcept;

    Index count() const noexcept { return start[start.size() - 1]; }
    // Returns the edge between two points, or none.
    Index find(Index a, Index b) const noexcept;
    bool is_boundary(Index edge) const noexcept { return second[edge] < 0; }

    // Calls visit(edge, smaller point, larger point) for all edges.
    template <class Visit>
    void for_each(Visit visit) const noexcept {
        for (Index point = 0; point + 1 < start.count(); ++point) {
            for (Index edge = start[point]; edge < start[point + 1]; ++edge)
                visit(edge, point, first[edge].end);
        }
    }
};

constexpr Index cell_of_side(Index code) noexcept { return code >> 1; }
constexpr bool runs_backwards(Index code) noexcept { return (code & 1) != 0; }

}  // namespace harmorph
