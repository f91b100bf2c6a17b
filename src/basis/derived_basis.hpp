// A basis that is made from another one: the same problem with other functions.
// tests/basis/test_combination.cpp covers this file.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

// Copies all but the values, which become 0, and the combination. `to` has been laid out for these
// counts; `to` is not sealed.
void begin_derived(Basis const& from, BasisCounts const& counts, Basis const& to) noexcept;

// A basis whose functions combine the functions of another basis, one for each design variable.

// Returns the counts for n functions F M in place of the functions F of `from`; M has entries of 1
// number (real) or 2 (complex).
BasisCounts combined_counts(Basis const& from, Index n, Index numbers) noexcept;

// Combines the functions. `to` has been laid out for combined_counts(); `from` is solved, complete
// and in double precision. Refuses a matrix with dependent columns before it writes any function.
Status combine(Basis const& from, Index n, Index numbers, const Real* matrix, Basis const& to,
               Fault& fault) noexcept;

// A basis with functions in single precision: a morph and its transpose read half as many bytes.
// Points of the wall, and points joined to them, keep rows in double precision; their movements are
// bitwise those of the original basis. Elsewhere each number is rounded to single precision: the
// relative error is at most 2^-24, or below 2^-126 the absolute error is at most 2^-150.

BasisCounts single_counts(Basis const& from) noexcept;

// Stores the functions of `from`, which is solved and in double precision, in `to`, which has been
// laid out for these counts. Refuses values that are too large.
Status store_single(Basis const& from, Basis const& to, Fault& fault) noexcept;

}  // namespace harmorph
