// What cells add to the matrix, in a header so that the compiler can inline it: it is the inner
// loop of the assembly.
#pragma once

#include "operators/cell_group.hpp"

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

// The same of a long row; not inlined, as this is rare.
__attribute__((noinline)) inline Offset find_in_long_row(Span<const Index> columns, Offset begin,
                                                         Offset end, Index column) noexcept {
    return find_in_order(columns, begin, end, column);
}

// Nearly all rows are short: here smaller columns are counted without branches, which would often
// be mispredicted. Reads `short_row` columns from the row's first one on, beyond the end of the row
// if that is shorter.
inline __attribute__((always_inline)) Offset find_in_row(Span<const Index> columns, Offset begin,
                                                         Offset end, Index column) noexcept {
    static_assert(Matrix::short_row == 8, "two vectors");
    if (end - begin > Matrix::short_row) return find_in_long_row(columns, begin, end, column);
    const FourIndices* const row = reinterpret_cast<const FourIndices*>(columns.data() + begin);
    Index const length = static_cast<Index>(end - begin);
    FourIndices const number = {0, 1, 2, 3};
    FourIndices const before =
        ((row[0] < column) & (number < length)) + ((row[1] < column) & (number + 4 < length));
    TwoPairs const pairs = reinterpret_cast<TwoPairs>(-before);
    std::int64_t const sums = pairs[0] + pairs[1];
    return begin + ((sums + (sums >> 32)) & 15);
}

// Inlined, without a branch for each corner, which would often be mispredicted.
template <Index n_components>
inline __attribute__((always_inline)) bool Matrix::concerns(RowRange rows,
                                                            Cell const& cell) const noexcept {
    bool any = false, any_row = false;
    for (Index k = 0; k < cell.n; ++k) {
        for (Index c = 0; c < n_components; ++c) {
            Index const row = row_of(n_components * cell.point[k] + c);
            any |= rows.contain(row);
            any_row |= row >= 0;
        }
    }
    return any || (!any_row && rows.begin == 0);
}

// The numbers added to a row do not depend on which other rows are in range: results are the same
// for any number of threads.
template <bool with_circulation, Index corners>
void Matrix::add_corners(RowRange rows, CellGroup<corners> const& cells, Index begin, Index end,
                         Real half) const noexcept {
    using Group = CellGroup<corners>;
    Index row[Group::most][corners];
    Offset place[Group::most][Group::n_pairs];
    bool is_inside[Group::most];  // all corners of the cell are unknowns in range, and no two are
                                  // the same
    for (Index c = begin; c < end; ++c) {
        Index at[corners];
        for (Index k = 0; k < corners; ++k) row[c][k] = at[k] = row_of(cells.point[c][k]);
        bool inside = true;
        for (Index k = 0; k < corners; ++k)
            inside = inside & rows.contain(at[k]) & (at[k] != at[(k + 1) % corners]);
        for (Index k = 0; k < Group::n_across; ++k) inside = inside & (at[k] != at[k + 2]);
        is_inside[c] = inside;
        if (!inside) continue;
        auto const place_of = [&](Index a, Index b) {
            Index const first = min(a, b);
            return find_in_row(column, start[first], start[first + 1], max(a, b));
        };
        for (Index k = 0; k < corners; ++k) place[c][k] = place_of(at[k], at[(k + 1) % corners]);
        for (Index k = 0; k < Group::n_across; ++k)
            place[c][corners + k] = place_of(at[k], at[k + 2]);
    }
    for (Index c = begin; c < end; ++c) {
        Index const(&at)[corners] = row[c];
        CellConductances const conductance = cells.conductances(c);
        Real const circulation = half * cells.conductivity[c];
        if (!is_inside[c]) {
            add_beside_known<with_circulation, corners>(rows, at, conductance, circulation);
            continue;
        }
        for (Index k = 0; k < corners; ++k) diagonal[at[k]] += conductance.sum_at<corners>(k);
        for (Index k = 0; k < corners; ++k) {
            value[place[c][k]] -= conductance.side[k];
            if (with_circulation)
                imaginary[place[c][k]] +=
                    at[(k + 1) % corners] < at[k] ? -circulation : circulation;
        }
        for (Index k = 0; k < Group::n_across; ++k)
            value[place[c][corners + k]] -= conductance.across[k];
    }
}

template <bool with_circulation, Index corners>
__attribute__((noinline)) void Matrix::add_beside_known(RowRange rows, Index const (&at)[corners],
                                                        CellConductances conductance,
                                                        Real circulation) const noexcept {
    constexpr Index n_across = CellGroup<corners>::n_across;
    for (Index k = 0; k < corners; ++k) {
        conductance.side[k] = at[k] == at[(k + 1) % corners] ? 0 : conductance.side[k];
    }
    for (Index k = 0; k < n_across; ++k)
        conductance.across[k] = at[k] == at[k + 2] ? 0 : conductance.across[k];
    for (Index k = 0; k < corners; ++k) {
        if (rows.contain(at[k])) diagonal[at[k]] += conductance.sum_at<corners>(k);
    }
    for (Index k = 0; k < corners; ++k) {
        add_off_diagonal<with_circulation>(rows, at[k], at[(k + 1) % corners], conductance.side[k],
                                           circulation);
    }
    for (Index k = 0; k < n_across; ++k) {
        add_off_diagonal<with_circulation>(rows, at[k], at[k + 2], conductance.across[k], 0);
    }
}

}  // namespace harmorph
