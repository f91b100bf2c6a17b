// The known values on the wall, and the right-hand sides that they make in the equations of
// neighbouring unknowns. tests/operators/test_residual.cpp and tests/morph/test_displacement.cpp
// cover this file.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

// Sets the values on the wall to the boundary functions, the values of unknowns to the right-hand
// sides, which engines replace by the solution, and all others to 0.
void set_right_hand_sides(Matrix const& matrix, Basis const& basis, DofValues const& dofs,
                          Executor const& executor = {}) noexcept;

// Sets the values on the wall to the boundary functions, as set_right_hand_sides() does, and
// changes no others.
void set_wall_values(Matrix const& matrix, Basis const& basis, DofValues const& dofs) noexcept;

// Let C be the couplings of unknowns to the wall, w the values on the wall and r the values of the
// unknowns, all columns. subtract_couplings() computes r -= C w, the right-hand sides that known
// values make; subtract_transposed_couplings() computes w -= C^H r.
void subtract_couplings(Matrix const& matrix, DofValues const& dofs) noexcept;
void subtract_transposed_couplings(Matrix const& matrix, DofValues const& dofs) noexcept;

}  // namespace harmorph
