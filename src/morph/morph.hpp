// Moves mesh points: functions times movements.
#pragma once

#include "basis/basis.hpp"
#include "base/executor.hpp"

namespace harmorph {

// Computes to = from + sum_i F_i move_i; move [2 * functions] has x,y pairs. `from` not given means
// 0. If the sum is 0, the coordinate keeps its bits, including those of a -0.0.
void morph(Basis const& basis, const Real* move, Points from, MutablePoints to,
           Executor const& executor) noexcept;

}  // namespace harmorph
