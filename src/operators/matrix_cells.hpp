// What a cell adds to the matrix, in a header so that the compiler can inline it: it is the inner loop of the assembly.
#pragma once

#include "harmorph/operators/matrix.hpp"

namespace harmorph {

// The position of `column` in the increasing list `columns`, which must contain it.
template <class I>
I find_in_order(Span<const Index> columns, I begin, I end, Index column) noexcept {
    while (end - begin > 16) {
        I const middle = begin + (end - begin) / 2;
        (columns[middle] <= column ? begin : end) = middle;
    }
    while (columns[begin] != column) ++begin;
    return begin;
}

typedef Index FourIndices __attribute__((vector_size(16), aligned(4), may_alias));
typedef std::int64_t TwoPairs __attribute__((vector_size(16)));

// Nearly all rows are short: here smaller columns are counted without branches, which would often be mispredicted.
// Reads `short_row` columns from the row's first one on, beyond the end of the row if that is shorter.
inline __attribute__((always_inline)) Offset find_in_row(Span<const Index> columns, Offset begin, Offset end,
                                                         Index column) noexcept {
    static_assert(Matrix::short_row == 8, "two vectors");
    if (end - begin > Matrix::short_row) return find_in_order(columns, begin, end, column);
    const FourIndices* const row = reinterpret_cast<const FourIndices*>(columns.data() + begin);
    Index const length = static_cast<Index>(end - begin);
    FourIndices const number = {0, 1, 2, 3};
    FourIndices const before = ((row[0] < column) & (number < length)) + ((row[1] < column) & (number + 4 < length));
    TwoPairs const pairs = reinterpret_cast<TwoPairs>(-before);
    std::int64_t const sums = pairs[0] + pairs[1];
    return begin + ((sums + (sums >> 32)) & 15);
}

// Does the cell lie on a side of a passage that is turned against the other side?
inline __attribute__((always_inline)) bool Matrix::is_turned(Cell const& cell) const noexcept {
    bool any = false;
    for (Index k = 0; k < cell.n; ++k) any = any || frame[cell.point[k]].y != 0 || frame[cell.point[k]].x != 1;
    return any;
}

// The numbers added to a row do not depend on which other rows are in range: results are the same for any number of
// threads.
template <bool with_circulation, Index corners>
inline __attribute__((always_inline)) void Matrix::add_corners(RowRange rows, Cell const& cell,
                                                               CellConductances conductance,
                                                               Real circulation) const noexcept {
    Index at[corners];
    bool is_inside = true;  // all corners of the cell are unknowns in range, and no two are the same
    for (Index k = 0; k < corners; ++k) at[k] = row_of[cell.point[k]];
    constexpr Index n_across = corners == 4 ? 2 : 0;
    for (Index k = 0; k < corners; ++k) is_inside = is_inside && rows.contain(at[k]) && at[k] != at[(k + 1) % corners];
    for (Index k = 0; k < n_across; ++k) is_inside = is_inside && at[k] != at[k + 2];
    if (!is_inside) {
        for (Index k = 0; k < corners; ++k) {
            conductance.side[k] = at[k] == at[(k + 1) % corners] ? 0 : conductance.side[k];
        }
        for (Index k = 0; k < n_across; ++k) conductance.across[k] = at[k] == at[k + 2] ? 0 : conductance.across[k];
    }
    Real sum[corners];
    for (Index k = 0; k < corners; ++k) {
        Real const sides = conductance.side[(k + corners - 1) % corners] + conductance.side[k];
        sum[k] = corners == 4 ? sides + conductance.across[k & 1] : sides;
    }
    if (!is_inside) {
        for (Index k = 0; k < corners; ++k) {
            if (rows.contain(at[k])) diagonal[at[k]] += sum[k];
        }
        for (Index k = 0; k < corners; ++k) {
            add_off_diagonal<with_circulation>(rows, at[k], at[(k + 1) % corners], conductance.side[k], circulation);
        }
        for (Index k = 0; k < n_across; ++k) {
            add_off_diagonal<with_circulation>(rows, at[k], at[k + 2], conductance.across[k], 0);
        }
        return;
    }
    for (Index k = 0; k < corners; ++k) diagonal[at[k]] += sum[k];
    auto const entry = [&](Index a, Index b) {
        Index const row = smaller(a, b);
        return find_in_row(column, start[row], start[row + 1], larger(a, b));
    };
    for (Index k = 0; k < corners; ++k) {
        Index const a = at[k], b = at[(k + 1) % corners];
        Offset const of_side = entry(a, b);
        value[of_side] -= conductance.side[k];
        if (with_circulation) imaginary[of_side] += b < a ? -circulation : circulation;
    }
    for (Index k = 0; k < n_across; ++k) value[entry(at[k], at[k + 2])] -= conductance.across[k];
}

}  // namespace harmorph
