// The operators on triangles and quads: the compact median-dual scheme of Laplace's equation,
// weighted and conformal.
#pragma once

#include "operators/matrix.hpp"

namespace harmorph {

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

}  // namespace harmorph
