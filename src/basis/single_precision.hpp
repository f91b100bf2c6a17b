// A basis with functions in single precision: a morph and its transpose read half as many bytes.
// Points of the wall, and points joined to them, keep rows in double precision; their movements are
// bitwise those of the original basis. Elsewhere each number is rounded to single precision: the
// relative error is at most 2^-24, or below 2^-126 the absolute error is at most 2^-150.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

BasisCounts single_counts(Basis const& from) noexcept;

// Stores the functions of `from`, which is solved and in double precision, in `to`, which has been
// laid out for these counts. Refuses values that are too large.
Status store_single(Basis const& from, Basis const& to, Fault& fault) noexcept;

}  // namespace harmorph
