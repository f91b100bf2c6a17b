// The operators on triangles and quads: compact median-dual scheme of Laplace's equation, weighted and conformal.
#pragma once

#include "harmorph/operators/matrix.hpp"

namespace harmorph {

// Flux through the median-dual face between two points with the gradient of the cell: in a triangle this is half the
// cotangent of the angle opposite to the edge (= linear finite elements); in a quad the mean of its two splits into
// triangles, which couples the diagonals too. Linear fields are reproduced exactly.
//
// The conformal operator minimises the integral of k |f_x + i f_y|^2, the departure of z -> f(z) from angle-preserving maps,
// instead of that of k |grad f|^2. The two differ by the integral of a divergence in each cell: a circulation of k / 2 along
// every side, counter-clockwise, which is all that is left where k jumps. (The discrete Cauchy-Riemann energy of B. Levy,
// S. Petitjean, N. Ray, J. Maillot, ACM Trans. Graph. 21 (2002) 362.)
//
// conductivity [n_cells]: k > 0, or empty: 1. Returns the first cell with a corner that has no positive area, or none; the
// matrix is of use only then. A real matrix has no room for the conformal operator.
Index assemble_stiffness(OrientedMesh const& cells, Points points, Span<const Real> conductivity, bool conformal,
                         Matrix const& matrix, Executor const& executor) noexcept;

}  // namespace harmorph
