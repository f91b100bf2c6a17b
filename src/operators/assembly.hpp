// The matrix of an operator on the cells of a mesh. Only this file knows the data that each
// operator needs. tests/operators/test_stiffness.cpp and tests/plan/test_weighted.cpp cover this
// file.
#pragma once

#include "boundary/distance.hpp"
#include "operators/stiffness.hpp"

namespace harmorph {

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
