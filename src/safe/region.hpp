// The part of a mesh round its inverted corners: which points may move there, their cells, and
// their neighbours.
#pragma once

#include "base/arena.hpp"
#include "mesh/guard_shape.hpp"
#include "mesh/region_counts.hpp"

namespace harmorph {

// A mesh whose cells are to be made valid, without its coordinates.
struct Tangle {
    Mesh mesh;                    // `points` is not looked at
    Points reference;             // of valid cells: the shapes and sizes wanted
    Span<std::uint8_t> reversed;  // [cells and guards]
    Span<const Index>
        representative;  // [n_points] points of a cut, or of a periodic pair, move as one
    Span<const std::uint8_t> held;  // [n_points] 1: does not move; of representatives
    Span<const Vec2> line = {};     // [n_points] unit vector along the line that a representative
                                    // slides on; (0, 0): moves anywhere. Empty: all move anywhere
    Span<const Vec2> turn =
        {};  // [n_points] what turns the movement of an unknown into that of the point, on
             // sides of a passage that are turned against each other. Empty: nothing

    // Counter-clockwise.
    Cell cell(Index i) const noexcept {
        Cell shape = mesh.cell(i);
        if (reversed[i] != 0) shape.reverse();
        return shape;
    }
    // Of cell or guard i.
    CellShape shape(Index i, Points points) const noexcept {
        return shape_of({mesh, reversed}, i, points);
    }
    Vec2 turned_alike(Index point, Vec2 movement) const noexcept {
        return turn.empty() ? movement : product(turn[point], movement);
    }
    Vec2 turned_to_unknown(Index point, Vec2 derivative) const noexcept {
        return turn.empty() ? derivative : product(conjugate(turn[point]), derivative);
    }
    bool slides(Index point) const noexcept { return !line.empty() && square(line[point]) > 0; }
};

// A corner, the second point, with its neighbours; the side to the first one turned back, see
// guard_shape.hpp.
struct CornerPoints {
    Index point[3] = {};
    Vec2 turn = {1, 0};

    Index operator[](Index k) const noexcept { return point[k]; }
};

// Each corner of a cell with its neighbours; the corners of a triangle are one and the same.
struct CellTriangles {
    Index n = 0;
    CornerPoints point[4] = {};

    CellTriangles(Tangle const& tangle, Index i) noexcept : CellTriangles(tangle.cell(i)) {
        point[0].turn = turn_of(tangle.mesh, i);
    }
    explicit CellTriangles(Cell const& cell) noexcept : n(cell.n == 3 ? 1 : 4) {
        for (Index k = 0; k < n; ++k) {
            Index const corner = cell.n == 3 ? 1 : k;
            point[k].point[0] = cell.previous(corner);
            point[k].point[1] = cell.point[corner];
            point[k].point[2] = cell.next(corner);
        }
    }
};

struct Region {
    static constexpr Index whole = 200;  // layers that count as all there are

    Index n = 0;        // points that may move: the unknowns
    Index n_cells = 0;  // cells with an unknown point
    Span<Index>
        unknown;  // [n_points] number of a point, or none; points that move as one have the same
    Span<Index> point;         // [n] representative of each unknown
    Span<Index> cell;          // [cells and guards] in order
    Span<Offset> start;        // [n + 1]
    Span<Offset> outer_start;  // [n]
    // Unknowns that share a cell with each, from `start` on: itself first; then those with larger
    // numbers in its range (range_start() in parallel_reduce.hpp says which these are); from
    // outer_start on, all that are in other ranges.
    Span<Index> neighbour;
    Span<Offset> cell_start;     // [n_points + 1]
    Span<Index> cell_of;         // all cells of each representative
    Span<std::uint8_t> reached;  // [n_points] working space
    Span<Index> queue;           // [n_points] working space

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    // Once for a mesh: the cells of each point.
    void link(Tangle const& tangle) noexcept;
    // As cells, those of the mesh for which is_one(cell) holds; leaves only those of the cells for
    // which it does.
    template <class IsOne>
    void choose(IsOne is_one) noexcept;
    template <class IsOne>
    void keep(IsOne is_one) noexcept;
    // From those cells to all points within `layers` cells of them; from `whole` on, to all points.
    void grow(Tangle const& tangle, Index layers) noexcept;

    Span<const Index> cells_of(Index mesh_point) const noexcept {
        return cell_of.from(cell_start[mesh_point],
                            cell_start[mesh_point + 1] - cell_start[mesh_point]);
    }
    Span<const Index> of(Index u) const noexcept {
        return neighbour.from(start[u], start[u + 1] - start[u]);
    }
    bool can_move(CornerPoints const& corner) const noexcept {
        return unknown[corner[0]] != none || unknown[corner[1]] != none ||
               unknown[corner[2]] != none;
    }

private:
    Index reach_points(Tangle const& tangle, Index layers) noexcept;
    void list_cells(Tangle const& tangle) noexcept;
    void list_neighbours(Tangle const& tangle) noexcept;
};

template <class IsOne>
void Region::choose(IsOne is_one) noexcept {
    n_cells = 0;
    for (Index i = 0; i < cell.count(); ++i) {
        if (is_one(i)) cell[n_cells++] = i;
    }
}

template <class IsOne>
void Region::keep(IsOne is_one) noexcept {
    Index kept = 0;
    for (Index const i : cell.first(n_cells)) {
        if (is_one(i)) cell[kept++] = i;
    }
    n_cells = kept;
}

}  // namespace harmorph
