// The functions that add cells to the matrix are in a header so that the compiler can inline them,
// as they are the inner loop of the assembly. tests/operators/test_matrix.cpp covers this
// file.
#pragma once

#include "operators/matrix.hpp"

namespace harmorph {

// A few cells that are treated together: vectors compute their conductances, and the entries of one
// cell in the matrix are found while the processor waits for the memory of another.

// Cells with the same number of corners, in the order of the mesh, counter-clockwise.
template <Index corners>
struct CellGroup {
    static constexpr Index max_count = 16;
    static constexpr Index n_across = corners == 4 ? 2 : 0;
    static constexpr Index n_pairs = corners + n_across;

    Index count = 0;
    Index number[max_count];
    Index point[max_count][corners];
    Real x[corners][max_count], y[corners][max_count];
    Real conductivity[max_count];
    Real side[corners][max_count],
        across[2][max_count];  // The conductances, as in CellConductances.

    bool is_full() const noexcept { return count == max_count; }
    void add(Index cell_number, Cell const& added, Points points, Real k_of_cell) noexcept {
        Index const c = count++;
        number[c] = cell_number;
        conductivity[c] = k_of_cell;
        for (Index k = 0; k < corners; ++k) {
            Vec2 const p = points[added.point[k]];
            point[c][k] = added.point[k];
            x[k][c] = p.x;
            y[k][c] = p.y;
        }
    }
    // Repeats the last cell if the number of cells is odd.
    void fill_up() noexcept {
        if (count % 2 == 0) return;
        number[count] = number[count - 1];
        conductivity[count] = conductivity[count - 1];
        for (Index k = 0; k < corners; ++k) {
            x[k][count] = x[k][count - 1];
            y[k][count] = y[k][count - 1];
        }
    }
    Cell cell(Index c) const noexcept {
        Cell out;
        out.n = corners;
        for (Index k = 0; k < corners; ++k) out.point[k] = point[c][k];
        return out;
    }
    CellConductances conductances(Index c) const noexcept {
        CellConductances out;
        for (Index k = 0; k < corners; ++k) out.side[k] = side[k][c];
        for (Index k = 0; k < n_across; ++k) out.across[k] = across[k][c];
        return out;
    }
};

// Returns the position of `column` in the increasing list `columns`, which must contain `column`.
template <class I>
I find_in_order(Span<const Index> columns, I begin, I end, Index column) noexcept {
    while (end - begin > 16) {
        I const middle = begin + (end - begin) / 2;
        (columns[middle] <= column ? begin : end) = middle;
    }
    while (columns[begin] != column) ++begin;
    return begin;
}

using FourIndices [[gnu::vector_size(16), gnu::aligned(4), gnu::may_alias]] = Index;
using TwoPairs [[gnu::vector_size(16)]] = std::int64_t;

// Searches a long row. The function is not inlined, as long rows are rare.
__attribute__((noinline)) inline Offset find_in_long_row(Span<const Index> columns, Offset begin,
                                                         Offset end, Index column) noexcept {
    return find_in_order(columns, begin, end, column);
}

// Searches any row. Nearly all rows are short: smaller columns are counted without branches, which
// would often be mispredicted. The function reads `short_row` columns from the first column of the
// row on, even beyond the end of a shorter row.
inline __attribute__((always_inline)) Offset find_in_row(Span<const Index> columns, Offset begin,
                                                         Offset end, Index column) noexcept {
    static_assert(Matrix::short_row == 8, "a short row is two vectors");
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

// The function is inlined and has no branch for each corner, which would often be mispredicted.
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

// The numbers that are added to a row do not depend on the other rows in the range, so results are
// the same for any number of threads.
template <bool with_circulation, Index corners>
void Matrix::add_corners(RowRange rows, CellGroup<corners> const& cells, Index begin, Index end,
                         Real circulation_factor) const noexcept {
    using Group = CellGroup<corners>;
    Index row[Group::max_count][corners];
    Offset place[Group::max_count][Group::n_pairs];
    // All corners of the cell are unknowns in the range, and no two of them are the same.
    bool is_inside[Group::max_count];
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
        Real const circulation = circulation_factor * cells.conductivity[c];
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
