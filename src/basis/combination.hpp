// A basis whose functions are combinations of those of another basis, one for each design variable.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

// Returns the counts for n functions F M in place of those of `from`; M has entries of 1 number
// (real) or 2 (complex).
BasisCounts combined_counts(Basis const& from, Index n, Index numbers) noexcept;

// Combines the functions. `to` has been laid out for combined_counts(); `from` is solved, complete
// and in double precision. Refuses a matrix with dependent columns before it writes any function.
Status combine(Basis const& from, Index n, Index numbers, const Real* matrix, Basis const& to,
               Fault& fault) noexcept;

}  // namespace harmorph
