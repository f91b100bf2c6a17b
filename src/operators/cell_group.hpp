// A few cells that are treated together: vectors compute their conductances, and the entries of one
// cell in the matrix are found while the processor waits for the memory of another.
// tests/operators/test_stiffness.cpp covers this file.
#pragma once

#include "operators/matrix.hpp"

namespace harmorph {

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

}  // namespace harmorph
