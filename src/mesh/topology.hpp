// Describes how the cells of a mesh are connected: the orientation of each cell, the points that
// are joined, and the edges between cells. tests/mesh/test_orientation.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// Finds the edges of the mesh, each with the cells on both sides.

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

// Gives all cells of the caller in counter-clockwise order.
struct OrientedMesh {
    Mesh mesh;
    // [cells and guards] 1 if the cell's points are in clockwise order; the array is empty if no
    // cell is clockwise.
    Span<std::uint8_t> reversed;

    Cell cell(Index i) const noexcept {
        Cell out = mesh.cell(i);
        if (!reversed.empty() && reversed[i] != 0) out.reverse();
        return out;
    }
};

// Analysis::run() builds the topology in this order: points that a cut joins get one
// representative, the edges between representatives are found, and cells are oriented by their
// common edges. The points of periodic pairs are joined last, so that both sides of a pair keep
// separate edges. The topology does not depend on coordinates; `mesh` still points to the
// coordinates with which the mesh was analysed.
struct Topology : OrientedMesh {
    Edges edges;
    Span<Index> representative;  // [n_points] the smallest of the points to which a point is joined

    void lay_out(Arena& arena, Mesh const& counts) noexcept {
        arena.take(reversed, counts.n_checked());
        edges.lay_out(arena, counts);
        arena.take(representative, counts.n_points);
    }
};

// Counts points, cells with guards, and pairs of neighbours in a mesh. No region of the mesh has
// larger counts.
struct RegionCounts {
    Index points = 0, cells = 0;
    Offset cell_corners = 0;  // the number of corners of all cells
    Offset pairs = 0;         // the number of pairs of points that have a cell in common

    static RegionCounts of(Topology const& topology) noexcept;
};

}  // namespace harmorph
