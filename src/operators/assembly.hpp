// The matrix of an operator on the cells of a mesh. Only this file knows the data that each
// operator needs. tests/operators/test_stiffness.cpp and tests/plan/test_weighted.cpp cover this
// file.
#pragma once

#include "boundary/distance.hpp"
#include "mesh/delaunay.hpp"
#include "operators/matrix.hpp"

namespace harmorph {

// Laplace's operator on the Delaunay triangulation of the mesh's points: the bounded scheme.

// The bounded scheme is the compact scheme on other triangles: the conductance of an edge is half
// the sum of the two cotangents opposite to the edge, times k at the midpoint of the edge. Linear
// fields are reproduced exactly if k is constant.
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

// The operators on triangles and quads: the compact median-dual scheme of Laplace's equation,
// weighted and conformal.

// The flux through the median-dual face between two points is computed with the gradient of the
// cell. In a triangle the conductance is half the cotangent of the angle opposite to the edge, as
// with linear finite elements; in a quad it is the mean of the two splits into triangles, which
// couples the diagonals too. Linear fields are reproduced exactly.
//
// The conformal operator minimises the integral of k |f_x + i f_y|^2, the deviation of z -> f(z)
// from a conformal map, instead of the integral of k |grad f|^2. In each cell the two integrands
// differ by a divergence, whose integral is a circulation of k / 2 along every side,
// counter-clockwise; the circulations of neighbouring cells cancel unless k jumps. (This is the
// discrete Cauchy-Riemann energy of B. Levy, S. Petitjean, N. Ray, J. Maillot, ACM Trans. Graph. 21
// (2002) 362.)
//
// conductivity [n_cells] is k > 0, or empty, which means 1. Returns none, or the first cell with a
// corner without positive area, in which case the matrix must not be used. The conformal operator
// needs a matrix that is complex or couples x and y.
Index assemble_stiffness(OrientedMesh const& cells, Points points, Span<const Real> conductivity,
                         bool conformal, Matrix const& matrix, Executor const& executor) noexcept;

// Returns the number of conductivities that the operator needs for these cells; 0 means that all
// conductivities are 1.
inline Index conductivities_of(Method const& method, Index n_cells) noexcept {
    return method.exponent_quarters > 0 ? n_cells : 0;
}

// `walls` has the faces that move; they are built at `wall_points` if the operator needs them.
// conductivity [conductivities_of(method, cells)] is overwritten. Returns none, or the first cell
// with a corner without positive area, in which case the matrix must not be used.
Index assemble_operator(Method const& method, OrientedMesh const& cells, Points points,
                        FaceDistance& walls, Points wall_points, Span<Real> conductivity,
                        Matrix const& matrix, Executor const& executor) noexcept;

}  // namespace harmorph
