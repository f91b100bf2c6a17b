// Laplace's operator on the Delaunay triangulation of the mesh's points: the bounded scheme.
#pragma once

#include "mesh/delaunay.hpp"
#include "operators/matrix.hpp"

namespace harmorph {

// This is the compact scheme on other triangles: the conductance of an edge is half the sum of the
// two cotangents opposite to the edge, times k at the midpoint of the edge. Linear fields are
// reproduced exactly if k is constant.
//
// The two angles opposite to an inner edge of a Delaunay triangulation sum to pi at most, so no
// conductance is negative, and conductances that rounding makes negative are set to 0. The matrix
// is then an M-matrix. The discrete maximum principle 0 <= F_i <= 1 holds on any mesh and for any k
// > 0 if every boundary is fixed or on a curve: boundary edges then join two known values and are
// not part of the equations.
//
// Edges of a free boundary are part of the equations. Such an edge has one triangle, whose opposite
// angle may be obtuse, and no edge flip can change a boundary edge. Consistency then demands a
// negative conductance, and the maximum principle does not hold near this edge. The principle holds
// if no angle opposite to an edge of a free boundary is obtuse, for example if layers of flat quads
// meet the boundary at right angles.
//
// conductivity [n_edges] is k > 0 of each edge, or empty, which means 1. Returns none, or the first
// edge with a triangle without positive area, in which case the matrix must not be used.
Index assemble_bounded(Span<const DelaunayEdge> edges, Points points, Span<const Real> conductivity,
                       Matrix const& matrix) noexcept;

}  // namespace harmorph
