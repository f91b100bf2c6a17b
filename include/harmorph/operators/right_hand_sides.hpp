// The known values on the wall, and the right-hand sides that they make in the equations of neighbouring unknowns.
#pragma once

#include "harmorph/operators/residual.hpp"

namespace harmorph {

// Sets values on the wall to the boundary functions, those of unknowns to the right-hand sides, which engines replace
// by the solution, and all others to 0.
void set_right_hand_sides(Matrix const& matrix, DofValues const& dofs) noexcept;

}  // namespace harmorph
