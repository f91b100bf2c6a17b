// A basis that is made from another one: the same problem with other functions.
// tests/basis/test_combination.cpp covers this file.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

// Copies all but the values, which become 0, and the combination. `to` has been laid out for these
// counts; `to` is not sealed.
void begin_derived(Basis const& from, BasisCounts const& counts, Basis const& to) noexcept;

}  // namespace harmorph
