// The part of a mesh round its inverted corners: which points may move there, their cells, and their neighbours.
#pragma once

#include "harmorph/arena.hpp"
#include "harmorph/cell_shape.hpp"
#include "harmorph/edges.hpp"

namespace harmorph {

// A mesh whose cells are to be made valid, without its coordinates.
struct Tangle {
    Mesh mesh;                          // `points` is not looked at
    Points reference;                   // of valid cells: the shapes and sizes wanted
    Span<const std::uint8_t> reversed;  // [n_cells]
    Span<const Index> representative;   // [n_points] points of a cut move as one
    Span<const std::uint8_t> held;      // [n_points] 1: does not move, like all boundary points; of representatives

    // Counter-clockwise, in terms of representatives.
    Cell cell(Index i) const noexcept {
        Cell its = mesh.cell(i);
        for (Index k = 0; k < its.n; ++k) its.point[k] = representative[its.point[k]];
        if (reversed[i] != 0) its.reverse();
        return its;
    }
};

// Each corner of a cell with its neighbours; the corners of a triangle are one and the same.
struct CellTriangles {
    Index n = 0;
    Index point[4][3] = {};

    explicit CellTriangles(Cell const& cell) noexcept : n(cell.n == 3 ? 1 : 4) {
        for (Index k = 0; k < n; ++k) {
            Index const corner = cell.n == 3 ? 1 : k;
            point[k][0] = cell.previous(corner);
            point[k][1] = cell.point[corner];
            point[k][2] = cell.next(corner);
        }
    }
};

struct RegionCounts {
    Index points = 0, cells = 0;
    Offset cell_corners = 0;  // of all cells
    Offset pairs = 0;         // of points that share a cell, each once

    static RegionCounts of(Mesh const& mesh, Edges const& edges) noexcept;
};

struct Region {
    static constexpr Index whole = 200;  // layers that count as all there are

    Index n = 0;                  // unknown points
    Index n_cells = 0;            // cells with an unknown point
    Span<std::uint8_t> layer;     // [n_points] 0: outside; 1: of an inverted cell; and so on
    Span<Index> unknown;          // [n_points] number of a point, or none
    Span<Index> point;            // [n] increasing
    Span<Index> cell;             // [n_cells] increasing
    Span<Offset> cell_start;      // [n + 1]
    Span<Index> cell_of;          // the cells of each unknown
    Span<Offset> start;           // [n + 1]
    Span<Index> neighbour;        // unknowns that share a cell with each, itself first
    Span<Index> seen;             // [n] working space

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    // All points within `layers` cells of a cell that is inverted at `points`; from `whole` on, all points.
    void grow(Tangle const& tangle, Points points, Index layers) noexcept;

    bool can_move(const Index (&its)[3]) const noexcept {
        return unknown[its[0]] != none || unknown[its[1]] != none || unknown[its[2]] != none;
    }
    Span<const Index> cells_of(Index u) const noexcept {
        return cell_of.from(cell_start[u], cell_start[u + 1] - cell_start[u]);
    }
    Span<const Index> of(Index u) const noexcept { return neighbour.from(start[u], start[u + 1] - start[u]); }

private:
    void mark_layers(Tangle const& tangle, Points points, Index layers) noexcept;
    void list_unknowns(Tangle const& tangle) noexcept;
    void list_cells(Tangle const& tangle) noexcept;
    void list_neighbours(Tangle const& tangle) noexcept;
};

}  // namespace harmorph
