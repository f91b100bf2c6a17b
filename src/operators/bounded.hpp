// Laplace's operator on the Delaunay triangulation of the mesh's points: bounded scheme.
#pragma once

#include "mesh/delaunay.hpp"
#include "operators/matrix.hpp"

namespace harmorph {

// The compact scheme on other triangles: half the sum of the two cotangents opposite to an edge,
// times k at its midpoint. Linear fields are reproduced exactly where k is constant.
//
// The two angles opposite to an inner edge of a Delaunay triangulation sum to pi at most, so no
// conductance is negative; what rounding makes negative is set to 0. The matrix is then an
// M-matrix, and the discrete maximum principle 0 <= F_i <= 1 holds on any mesh and for any k > 0,
// if every boundary is fixed or on a curve: boundary edges then join two known values and are not
// part of the equations.
//
// Edges of a free boundary are part of the equations. Such an edge has one triangle, whose opposite
// angle may be obtuse, and no edge flip can change a boundary edge: then consistency demands a
// negative conductance, and the maximum principle is lost near this edge. It holds where no angle
// opposite to an edge of a free boundary is obtuse, for example where layers of flat quads meet the
// boundary at right angles.
//
// conductivity [n_edges]: k > 0 of each edge, or empty: 1. Returns none, or the first edge with a
// triangle without positive area; the matrix must not be used then.
Index assemble_bounded(Span<const DelaunayEdge> edges, Points points, Span<const Real> conductivity,
                       Matrix const& matrix) noexcept;

}  // namespace harmorph
