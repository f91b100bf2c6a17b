// The longest non-decreasing part of a sequence.
#pragma once

#include "base/span.hpp"

namespace harmorph {

// Positions of a longest non-decreasing subsequence of values [n], ascending, in run [0 .. returned
// count). Patience sorting, O(n log n): Fredman, Discrete Math. 11 (1975) 29. previous [n], run
// [n].
Index longest_run(Span<const Real> values, Span<Index> previous, Span<Index> run) noexcept;

}  // namespace harmorph
