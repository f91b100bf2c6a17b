// Computes sums and extremes over all cells. The cells are divided into a fixed number of ranges,
// so that the results do not depend on the number of threads. tests/base/test_shared_work.cpp
// covers this file.
#pragma once

#include "base/executor.hpp"

namespace harmorph {

// The items 0 .. n-1 are divided into this number of ranges; range_start() returns the first item
// of range i.
inline constexpr Index reduced_ranges = 16;
inline Index range_start(Index n, Index i) noexcept {
    return static_cast<Index>(Offset{n} * i / reduced_ranges);
}

// Calls add(begin, end, result) for ranges that together cover 0 .. n-1, and merges the results in
// the order of the ranges by result.merge(later).
template <class Result, class Add>
Result reduce_ranges(Index n, Executor const& executor, Add const& add) noexcept {
    Result results[reduced_ranges];
    executor.for_each(reduced_ranges, [&](Index range) {
        Result result;
        add(range_start(n, range), range_start(n, range + 1), result);
        results[range] = result;
    });
    for (Index range = 1; range < reduced_ranges; ++range) results[0].merge(results[range]);
    return results[0];
}

// Divides the items 0 .. n-1 into ranges, and returns the first item that find(begin, end) returns
// for any of them, or none.
template <class Find>
Index find_in_ranges(Index n, Executor const& executor, Find const& find) noexcept {
    struct First {
        Index item = none;
        void merge(First const& later) noexcept { item = item == none ? later.item : item; }
    };
    auto const add = [&](Index begin, Index end, First& first) { first.item = find(begin, end); };
    return reduce_ranges<First>(n, executor, add).item;
}

// Calls visit(cell, result) for all cells and returns the merged results.
template <class Result, class Visit>
Result reduce_cells(Index n_cells, Executor const& executor, Visit const& visit) noexcept {
    return reduce_ranges<Result>(n_cells, executor, [&](Index begin, Index end, Result& result) {
        for (Index cell = begin; cell < end; ++cell) visit(cell, result);
    });
}

}  // namespace harmorph
