// A basis whose functions are combinations of another's: one for each design variable.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

// n functions F M in place of those of `from`; M has entries of 1 number (real) or 2 (complex).
BasisCounts combined_counts(Basis const& from, Index n, Index numbers) noexcept;

// `to` has been laid out for combined_counts, `from` is solved, complete and in double precision.
// Before anything else the matrix is checked: refuses dependent columns.
Status combine(Basis const& from, Index n, Index numbers, const Real* matrix, Basis const& to,
               Fault& fault) noexcept;

}  // namespace harmorph
