// The part of a mesh around chosen cells: the points that may move there, their cells and their
// neighbours.
#pragma once

#include "base/arena.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// A mesh the cells of which are to become valid, without the coordinates of the mesh.
struct Tangle {
    Mesh mesh;                    // `points` is not read
    Points reference;             // of valid cells, which have the desired shapes and sizes
    Span<std::uint8_t> reversed;  // [cells and guards]
    // [n_points] Points of a cut, or of a periodic pair, move together and have one representative.
    Span<const Index> representative;
    Span<const std::uint8_t> held;  // [n_points] 1: the representative does not move
    // [n_points] The unit vector along the line on which a representative slips; (0, 0) if it
    // moves in any direction. Empty: all representatives move in any direction.
    Span<const Vec2> line = {};
    // [n_points] The factor that rotates the movement of an unknown into that of the point, on
    // sides of a passage that are rotated against each other. Empty: no point is rotated.
    Span<const Vec2> rotation = {};

    // Returns the corners of a cell or guard in counter-clockwise order.
    Cell cell(Index i) const noexcept {
        Cell shape = mesh.cell(i);
        if (reversed[i] != 0) shape.reverse();
        return shape;
    }
    // Returns the shape of cell or guard i.
    CellShape shape(Index i, Points points) const noexcept {
        return shape_of({mesh, reversed}, i, points);
    }
    Vec2 rotated_alike(Index point, Vec2 movement) const noexcept {
        return rotation.empty() ? movement : product(rotation[point], movement);
    }
    Vec2 rotated_to_unknown(Index point, Vec2 derivative) const noexcept {
        return rotation.empty() ? derivative : product(conjugate(rotation[point]), derivative);
    }
    bool slips(Index point) const noexcept { return !line.empty() && square(line[point]) > 0; }
};

// A corner, which is the second point, with its two neighbours. If the side to the first point is
// rotated, it is rotated back; see cell_shape.hpp.
struct CornerPoints {
    Index point[3] = {};
    Vec2 rotation = {1, 0};

    Index operator[](Index k) const noexcept { return point[k]; }
};

// The triangles of a cell: each corner with its neighbours. A triangle has one such triangle, as
// all its corners give the same.
struct CellTriangles {
    Index n = 0;
    CornerPoints point[4] = {};

    CellTriangles(Tangle const& tangle, Index i) noexcept : CellTriangles(tangle.cell(i)) {
        point[0].rotation = rotation_of(tangle.mesh, i);
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
    static constexpr Index whole = 200;  // this number of layers means the whole mesh

    Index n = 0;        // the number of unknowns, which are points that may move
    Index n_cells = 0;  // the number of cells that have an unknown point
    // [n_points] The number of the unknown that moves a point, or none; points that move together
    // have the same.
    Span<Index> unknown;
    Span<Index> point;         // [n] the representative of each unknown
    Span<Index> cell;          // [cells and guards] in order
    Span<Offset> start;        // [n + 1]
    Span<Offset> outer_start;  // [n]
    // The unknowns that share a cell with each unknown, from `start` on: first the unknown, then
    // those with larger numbers in the same range (range_start() in executor.hpp defines
    // ranges), and from outer_start on all those in other ranges.
    Span<Index> neighbour;
    Span<Offset> cell_start;     // [n_points + 1]
    Span<Index> cell_of;         // the cells of each representative
    Span<std::uint8_t> reached;  // [n_points] working space
    Span<Index> queue;           // [n_points] working space

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    // Finds the cells of each point, once for a mesh.
    void link(Tangle const& tangle) noexcept;
    // choose() sets the cells to those of the mesh for which is_one(cell) holds; keep() removes the
    // cells for which it does not hold.
    template <class IsOne>
    void choose(IsOne is_one) noexcept;
    template <class IsOne>
    void keep(IsOne is_one) noexcept;
    // Grows the region from these cells to all points within `layers` cells of them; with `whole`
    // layers or more, to all points of the mesh.
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
