// A few cells side by side: their conductances are computed by vectors, and the places of one cell
// in the matrix are found while the processor waits for the memory of another.
#pragma once

#include "operators/matrix.hpp"

namespace harmorph {

// Cells of the same number of corners, in the order of the mesh, counter-clockwise.
template <Index corners>
struct CellGroup {
    static constexpr Index most = 16;
    static constexpr Index n_across = corners == 4 ? 2 : 0;
    static constexpr Index n_pairs = corners + n_across;

    Index count = 0;
    Index number[most];
    Index point[most][corners];
    Real x[corners][most], y[corners][most];
    Real conductivity[most];
    Real side[corners][most], across[2][most];  // conductances, as in CellConductances

    bool is_full() const noexcept { return count == most; }
    void add(Index cell_number, Cell const& its, Points points, Real its_conductivity) noexcept {
        Index const c = count++;
        number[c] = cell_number;
        conductivity[c] = its_conductivity;
        for (Index k = 0; k < corners; ++k) {
            Vec2 const p = points[its.point[k]];
            point[c][k] = its.point[k];
            x[k][c] = p.x;
            y[k][c] = p.y;
        }
    }
    // Repeats the last cell where the number of cells is odd.
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
        Cell its;
        its.n = corners;
        for (Index k = 0; k < corners; ++k) its.point[k] = point[c][k];
        return its;
    }
    CellConductances conductances(Index c) const noexcept {
        CellConductances its;
        for (Index k = 0; k < corners; ++k) its.side[k] = side[k][c];
        for (Index k = 0; k < n_across; ++k) its.across[k] = across[k][c];
        return its;
    }
};

}  // namespace harmorph
