// Laplace's operator on the Delaunay triangulation of the mesh's points: bounded scheme.
#pragma once

#include "harmorph/mesh/delaunay.hpp"
#include "harmorph/operators/matrix.hpp"

namespace harmorph {

// The compact scheme on other triangles: half the sum of the two cotangents opposite to an edge, times k at its
// midpoint. Linear fields are reproduced exactly where k is constant.
//
// Of an inner edge the angles add up to pi at most, so no conductance is negative; what rounding leaves below 0 is set
// to 0. The matrix is an M-matrix then, and 0 <= F_i <= 1 for any mesh, whatever k, as long as every boundary is fixed
// or on a curve: edges of the boundary join known values there and are not part of the equations.
//
// At a free boundary they are. An edge on it has one triangle, whose opposite angle may be obtuse (no flip changes the
// boundary): its conductance is negative then, as consistency demands, and bounds hold no longer near it. They do hold
// where no angle opposite to an edge of a free boundary is obtuse, as behind layers of flat quads cut at right angles.
//
// conductivity [n_edges]: k > 0 of each edge, or empty: 1. Returns the first edge that has a triangle without positive
// area, or none; the matrix is of use only then.
Index assemble_bounded(Span<const DelaunayEdge> edges, Points points, Span<const Real> conductivity,
                       Matrix const& matrix) noexcept;

}  // namespace harmorph
