#include "base/longest_monotone.hpp"

namespace harmorph {

Index longest_run(Span<const Real> values, Span<Index> previous, Span<Index> run) noexcept {
    // Among all non-decreasing subsequences of l + 1 values so far, run[l] is the end of the one
    // whose last value is smallest.
    Index length = 0;
    for (Index k = 0; k < values.count(); ++k) {
        Index low = 0;
        Index high = length;
        while (low < high) {
            Index const middle = low + (high - low) / 2;
            if (values[run[middle]] <= values[k]) low = middle + 1;
            else high = middle;
        }
        previous[k] = low > 0 ? run[low - 1] : none;
        run[low] = k;
        if (low == length) ++length;
    }
    for (Index k = length > 0 ? run[length - 1] : none, l = length - 1; k != none;
         k = previous[k], --l)
        run[l] = k;
    return length;
}

}  // namespace harmorph
