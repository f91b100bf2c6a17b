// The cell of a mesh that contains a point, or the nearest cell, and the interpolation weights of
// the corners.
#pragma once

#include "mesh/box_tree.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// A linear field has the value sum_k weight_k f(point_k) at the point, interpolated inside the cell
// and extrapolated outside. The weights add up to 1; at a point of the mesh the weight of that
// point is exactly 1. In a quad they are the mean over the two splits into triangles, as in the
// equations.
struct CellWeights {
    Index n = 0;
    Index point[4] = {};
    Real weight[4] = {};
};

struct Location {
    Index cell = none;
    Real distance = 0;      // from the cell; 0: inside, or within rounding of it
    Real longest_side = 0;  // of the cell
    CellWeights weights;
};

struct Locator {
    OrientedMesh cells;
    BoxTree tree;

    void lay_out(Arena& arena, Index n_cells) noexcept { tree.lay_out(arena, n_cells); }
    // The mesh must have no inverted cell.
    void build(OrientedMesh const& mesh) noexcept;

    // hint: a cell that may well be the one, or none. A point on a common side belongs to either
    // cell.
    Location locate(Vec2 point, Index hint) const noexcept;

private:
    CellShape shape(Index cell) const noexcept {
        return {cells.cell(cell), cells.mesh.points, false};
    }
};

}  // namespace harmorph
