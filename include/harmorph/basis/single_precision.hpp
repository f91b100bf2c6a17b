// A basis with its functions in single precision: a morph and its transpose read half as much. Points of the wall, and
// what is joined to them, keep their rows in double precision; they move by the bits that they move by with the original.
// Elsewhere each number is the nearest one of single precision: off by 2^-24 of itself at most, or, below 2^-126, 2^-150.
#pragma once

#include "harmorph/basis/basis.hpp"

namespace harmorph {

BasisCounts single_counts(Basis const& from) noexcept;

// `to` has been laid out for these counts, `from` is solved and in double precision. Refuses values that are too large.
Status store_single(Basis const& from, Basis const& to, Fault& fault) noexcept;

}  // namespace harmorph
