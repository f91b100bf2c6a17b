// Finds the cell of a mesh that contains a point, or the nearest cell, and the interpolation
// weights of the corners.
#pragma once

#include "mesh/box_tree.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// A linear field f has the value sum_k weight_k f(point_k) at the located point; the sum
// interpolates inside the cell and extrapolates outside. The weights add up to 1; at a point of the
// mesh, the weight of that point is exactly 1. In a quad, the weights are the mean over the two
// splits into triangles, as in the equations.
struct CellWeights {
    Index n = 0;
    Index point[4] = {};
    Real weight[4] = {};
};

// Computes the weights [n] of the corners of a cell at a point.
void weigh_corners(CellShape const& shape, Vec2 point, Real* weight) noexcept;

struct Location {
    Index cell = none;
    Real distance = 0;      // from the cell; 0 inside the cell, to rounding
    Real longest_side = 0;  // the length of the longest side of the cell
    CellWeights weights;
};

struct Locator {
    OrientedMesh cells;
    BoxTree tree;

    void lay_out(Arena& arena, Index n_cells) noexcept { tree.lay_out(arena, n_cells); }
    // The mesh must have no inverted cell.
    void build(OrientedMesh const& mesh) noexcept;

    // hint is a cell that probably contains the point, or none. A point on a common side of two
    // cells may be found in either cell.
    Location locate(Vec2 point, Index hint) const noexcept;

private:
    CellShape shape(Index cell) const noexcept {
        return {cells.cell(cell), cells.mesh.points, false};
    }
};

}  // namespace harmorph
