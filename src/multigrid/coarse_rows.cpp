#include "multigrid/coarse_rows.hpp"

namespace harmorph {

void FullRows::lay_out(Arena& arena, Index rows, Offset entries) noexcept {
    arena.take(row_sum, rows);
    arena.take(strongest, rows);
    arena.take(start, Offset{rows} + 1);
    arena.take(column, 2 * entries);
    arena.take(value, 2 * entries);
}

void FullRows::find_strongest() noexcept {
    for (Index i = 0; i < n; ++i) {
        strongest[i] = 0;
        for (Offset e = start[i]; e < start[i + 1]; ++e)
            strongest[i] = max(strongest[i], -value[e]);
    }
}

}  // namespace harmorph
