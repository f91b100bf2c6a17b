#include "multigrid/coarse_rows.hpp"

namespace harmorph {

void FullRows::lay_out(Arena& arena, Index rows, Offset entries) noexcept {
    arena.take(row_sum, rows);
    arena.take(strongest, rows);
    arena.take(start_, Offset{rows} + 1);
    arena.take(column_, entries);
    arena.take(value_, entries);
}

void FullRows::find_strongest() noexcept {
    for (Index i = 0; i < n; ++i) {
        strongest[i] = 0;
        for_each(i, [&](Index, Real entry) { strongest[i] = max(strongest[i], -entry); });
    }
}

}  // namespace harmorph
