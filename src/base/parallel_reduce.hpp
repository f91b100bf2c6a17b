// Sums and extremes over all cells, in ranges whose number does not depend on that of the threads.
#pragma once

#include "base/executor.hpp"

namespace harmorph {

// Of 0 .. n-1, and where each of them begins.
inline constexpr Index reduced_ranges = 16;
inline Index range_start(Index n, Index i) noexcept {
    return static_cast<Index>(Offset{n} * i / reduced_ranges);
}

// add(begin, end, result) for ranges that are together 0 .. n-1; Result has merge(later).
template <class Result, class Add>
Result reduce_ranges(Index n, Executor const& executor, Add const& add) noexcept {
    Result part[reduced_ranges];
    executor.for_each(reduced_ranges, [&](Index range) {
        Result result;
        add(range_start(n, range), range_start(n, range + 1), result);
        part[range] = result;
    });
    for (Index range = 1; range < reduced_ranges; ++range) part[0].merge(part[range]);
    return part[0];
}

// The first of the items 0 .. n-1 that find(begin, end) finds in a range, or none.
template <class Find>
Index find_in_ranges(Index n, Executor const& executor, Find const& find) noexcept {
    struct First {
        Index item = none;
        void merge(First const& later) noexcept { item = item == none ? later.item : item; }
    };
    auto const add = [&](Index begin, Index end, First& first) { first.item = find(begin, end); };
    return reduce_ranges<First>(n, executor, add).item;
}

// visit(cell, result) for all cells.
template <class Result, class Visit>
Result reduce_cells(Index n_cells, Executor const& executor, Visit const& visit) noexcept {
    return reduce_ranges<Result>(n_cells, executor, [&](Index begin, Index end, Result& result) {
        for (Index cell = begin; cell < end; ++cell) visit(cell, result);
    });
}

}  // namespace harmorph
