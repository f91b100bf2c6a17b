// Sums and extremes over all cells, in ranges whose number does not depend on that of the threads.
#pragma once

#include "harmorph/executor.hpp"

namespace harmorph {

// visit(cell, result) for all cells; Result has merge(later).
template <class Result, class Visit>
Result reduce_cells(Index n_cells, Executor const& executor, Visit const& visit) noexcept {
    constexpr Index ranges = 16;
    Result part[ranges];
    auto const bound = [&](Index i) { return static_cast<Index>(Offset{n_cells} * i / ranges); };
    executor.for_each(ranges, [&](Index range) {
        Result result;
        for (Index cell = bound(range); cell < bound(range + 1); ++cell) visit(cell, result);
        part[range] = result;
    });
    for (Index range = 1; range < ranges; ++range) part[0].merge(part[range]);
    return part[0];
}

}  // namespace harmorph
