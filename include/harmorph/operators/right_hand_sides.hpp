// What is known on the wall, and what it puts on the right-hand sides of its neighbours' equations.
#pragma once

#include "harmorph/operators/residual.hpp"

namespace harmorph {

// All values 0 but those of the wall's points and, at the unknowns, the right-hand sides: what engines solve in place.
void set_right_hand_sides(Matrix const& matrix, Lines const& lines) noexcept;

}  // namespace harmorph
