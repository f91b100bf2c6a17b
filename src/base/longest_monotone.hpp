// Finds the longest non-decreasing subsequence of a sequence.
#pragma once

#include "base/span.hpp"

namespace harmorph {

// Writes the positions of a longest non-decreasing subsequence of values [n] to run [n], in
// ascending order, and returns their number. previous [n] is working memory. The method is patience
// sorting in O(n log n) steps: Fredman, Discrete Math. 11 (1975) 29.
Index longest_run(Span<const Real> values, Span<Index> previous, Span<Index> run) noexcept;

}  // namespace harmorph
