// A basis made from another one: the same problem with other functions.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

// Everything but the values, which are 0, and the combination. `to` has been laid out for these
// counts; it is not sealed.
void begin_derived(Basis const& from, BasisCounts const& counts, Basis const& to) noexcept;

}  // namespace harmorph
