#include "operators/symmetric_matrix.hpp"

#include "base/scalar.hpp"
#include "base/sort.hpp"

namespace harmorph {
namespace {

// Merges entries of one row that are in the same column, in the order of first appearance.
void merge_columns(SymmetricRows& rows, Span<Offset> last) noexcept {
    fill(last.first(rows.n), Offset{-1});
    Offset kept = 0;
    for (Index i = 0; i < rows.n; ++i) {
        Offset const begin = rows.start[i], end = rows.start[i + 1];
        Offset const first = kept;
        for (Offset e = begin; e < end; ++e) {
            Index const j = rows.column[e];
            Offset const to = last[j];
            if (to >= first) {
                rows.value[to] += rows.value[e];
                Index const faces = Index{rows.faces[to]} + rows.faces[e];
                rows.faces[to] = static_cast<std::uint8_t>(min(faces, Index{255}));
            } else {
                last[j] = kept;
                rows.column[kept] = j;
                rows.value[kept] = rows.value[e];
                rows.faces[kept] = rows.faces[e];
                ++kept;
            }
        }
        rows.start[i] = first;
    }
    rows.start[rows.n] = kept;
}

}  // namespace

void SymmetricRows::lay_out(Arena& arena, Index rows, Offset entries) noexcept {
    n = rows;
    arena.take(diagonal, rows);
    arena.take(row_sum, rows);
    arena.take(start, Offset{rows} + 1);
    arena.take(column, entries);
    arena.take(value, entries);
    arena.take(faces, entries);
}

void contract(SymmetricRows const& fine, Span<const Index> cell_of, Index n, Span<Offset> last,
              SymmetricRows& coarse) noexcept {
    coarse.n = n;
    fill(coarse.row_sum.first(n), 0.0);
    Span<Offset> const starts = coarse.start.first(n + 1);
    fill(starts, Offset{0});
    for (Index i = 0; i < fine.n; ++i) coarse.row_sum[cell_of[i]] += fine.row_sum[i];
    auto const is_needed = [&](Offset e) { return fine.value[e] != 0 || fine.faces[e] != 0; };
    fine.for_each([&](Index i, Index j, Offset e) {
        Index const a = cell_of[i], b = cell_of[j];
        if (a != b && is_needed(e)) ++starts[min(a, b)];
    });
    counts_to_starts(starts);
    fine.for_each([&](Index i, Index j, Offset e) {
        Index const a = cell_of[i], b = cell_of[j];
        if (a == b || !is_needed(e)) return;
        Offset const to = starts[min(a, b)]++;
        coarse.column[to] = max(a, b);
        coarse.value[to] = fine.value[e];
        coarse.faces[to] = fine.faces[e];
    });
    rewind_starts(starts);
    merge_columns(coarse, last);
    copy(coarse.diagonal.first(n), Span<const Real>(coarse.row_sum.first(n)));
    coarse.for_each([&](Index i, Index j, Offset e) {
        coarse.diagonal[i] -= coarse.value[e];
        coarse.diagonal[j] -= coarse.value[e];
    });
}

}  // namespace harmorph
