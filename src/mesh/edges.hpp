// The edges of the mesh, each with the cells on both sides.
#pragma once

#include "base/arena.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// Edges are kept with their smaller point, sorted by their larger one. A side is 2 * cell, + 1 if
// the cell runs along the edge from the larger point to the smaller.
struct Edges {
    static constexpr Index unmarked =
        -1;  // in `second`: boundary edge, no face known; below: -2 - number of the face

    struct Side {
        Index end;   // larger point
        Index code;  // 2 * cell + backwards
    };

    Span<Index> start;     // [n_points + 1]
    Span<Side> first;      // [count]
    Span<Index> second;    // [count] code of the other cell, or < 0
    Index n_boundary = 0;  // edges with a cell on one side only
    bool agree = false;    // the two cells of every other edge run along it in opposite directions

    // Arrays for as many edges as there could be.
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
    // representative [n_points]: the point that stands for each; empty: itself. Refuses an edge of
    // more than two cells.
    Status build(Mesh const& mesh, Span<const Index> representative, Fault& fault) noexcept;

    Index count() const noexcept { return start[start.size() - 1]; }
    Index find(Index a, Index b) const noexcept;  // none if there is no such edge
    bool is_boundary(Index edge) const noexcept { return second[edge] < 0; }

    // visit(edge, smaller point, larger point)
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
