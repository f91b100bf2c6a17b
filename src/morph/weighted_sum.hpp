// Adds up bases of several steps into one, the derivative of a morph in steps.
#pragma once

#include "basis/basis.hpp"
#include "base/executor.hpp"

namespace harmorph {

// Computes sum += F w: function i is multiplied by the complex number weight[i], which acts on a
// movement before F_i does. Both bases have the same counts. For real functions only the real part
// of the weight is used.
void add_weighted(Basis const& sum, Basis const& basis, Span<const Vec2> weight,
                  Executor const& executor) noexcept;

}  // namespace harmorph
