// Every compressed row structure is built by a counting sort: counting, prefix sums, filling. Items
// without integer keys are sorted by insertion or by a heap.
#pragma once

#include "base/span.hpp"

namespace harmorph {

// Replaces n counts in starts [n + 1] by the exclusive prefix sums, with the total as the last
// element, and returns the total.
template <class T>
T counts_to_starts(Span<T> starts) noexcept {
    T sum = 0;
    for (T& start : starts) {
        T const count = start;
        start = sum;
        sum += count;
    }
    return sum;
}

// Filling a row advances the start of the row to its end, where the next row starts. The starts
// are shifted back here.
template <class T>
void rewind_starts(Span<T> starts) noexcept {
    for (Size i = starts.size() - 1; i > 0; --i) starts[i] = starts[i - 1];
    starts[0] = 0;
}

// Sorts in place and keeps the order of equal items. The sort is fast for few items, and for many
// that are nearly in order.
template <class T, class Before>
void sort_by_insertion(Span<T> items, Before before) noexcept {
    for (Size i = 1; i < items.size(); ++i) {
        T const item = items[i];
        Size k = i;
        for (; k > 0 && before(item, items[k - 1]); --k) items[k] = items[k - 1];
        items[k] = item;
    }
}

// Sorts in place without extra memory. The order of equal items may change, so `before` must break
// ties.
template <class T, class Before>
void sort(Span<T> items, Before before) noexcept {
    constexpr Size few = 32;
    if (items.size() <= few) return sort_by_insertion(items, before);
    auto const sink = [&](Size root, Size end) {
        for (Size child = 2 * root + 1; child < end; child = 2 * root + 1) {
            if (child + 1 < end && before(items[child], items[child + 1])) ++child;
            if (!before(items[root], items[child])) return;
            T const item = items[root];
            items[root] = items[child];
            items[child] = item;
            root = child;
        }
    };
    for (Size root = items.size() / 2; root-- > 0;) sink(root, items.size());
    for (Size end = items.size(); end-- > 1;) {
        T const largest = items[0];
        items[0] = items[end];
        items[end] = largest;
        sink(0, end);
    }
}

}  // namespace harmorph
