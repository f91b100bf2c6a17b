// Adds up bases of several steps into one: the derivative of a morph in steps.
#pragma once

#include "harmorph/basis/basis.hpp"
#include "harmorph/base/executor.hpp"

namespace harmorph {

// sum += F w: each function times a complex number of its own, weight [functions], applied to movements before F is. Both
// bases have the same counts. Real values take the real part alone.
void add_weighted(Basis const& sum, Basis const& basis, Span<const Vec2> weight, Executor const& executor) noexcept;

}  // namespace harmorph
