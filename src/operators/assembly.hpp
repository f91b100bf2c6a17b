// The matrix of an operator on the cells of a mesh: the one place that knows which operator needs
// what.
#pragma once

#include "boundary/distance.hpp"
#include "operators/stiffness.hpp"

namespace harmorph {

// Numbers of conductivities of these cells that the operator needs; 0: they are 1.
inline Index conductivities_of(Method const& method, Index n_cells) noexcept {
    return method.exponent_quarters > 0 ? n_cells : 0;
}

// walls: the faces that move, chosen, which are built at `points` where the operator needs them.
// conductivity [conductivities_of(method, cells)] is overwritten. Returns none, or the first cell
// with a corner without positive area; the matrix must not be used then.
Index assemble_operator(Method const& method, OrientedMesh const& cells, Points points,
                        FaceDistance& walls, Points wall_points, Span<Real> conductivity,
                        Matrix const& matrix, Executor const& executor) noexcept;

}  // namespace harmorph
