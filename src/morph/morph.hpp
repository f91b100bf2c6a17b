// Functions times movements: mesh points from control points.
#pragma once

#include "basis/basis.hpp"
#include "base/executor.hpp"

namespace harmorph {

// to = from + sum_i F_i move_i; move [2 * functions] x,y pairs. `from` not given: 0. Where the sum
// is 0, the coordinate keeps its bits, that of a -0.0 included.
void morph(Basis const& basis, const Real* move, Points from, MutablePoints to,
           Executor const& executor) noexcept;

}  // namespace harmorph
