// A symmetric sparse matrix as one half of it, and its contraction: rows of cells that are merged are summed.
#pragma once

#include "harmorph/base/arena.hpp"

namespace harmorph {

// Row i holds its entries in later columns, as Matrix does, and its row sum, which is what couples the cell to known values.
// In thin cells couplings differ by 1e14. The entries beside the diagonal and the row sum determine what depends on the small
// couplings; the diagonal, in whose rounding they drown, does not (M. Dailey, F. M. Dopico, Q. Ye, Relative perturbation
// theory for diagonally dominant matrices). So products are sums of fluxes, (A x)_i = row_sum_i x_i + sum of entries
// (x_j - x_i): constants give 0 to the bit where the row sum is 0. And a contraction adds row sums. `faces` tells how many
// mesh edges run between the two cells (255: that or more); 0 for the diagonals of quads, which couple cells that do not
// touch.
struct SymmetricRows {
    Index n = 0;
    Span<Real> diagonal;       // [n] row sum - the sum of the row's other entries
    Span<Real> row_sum;        // [n]
    Span<Offset> start;        // [n + 1]
    Span<Index> column;
    Span<Real> value;
    Span<std::uint8_t> faces;

    void lay_out(Arena& arena, Index rows, Offset entries) noexcept;
    Offset entries() const noexcept { return start[n]; }

    // visit(row, column, entry) for each pair once.
    template <class Visit>
    void for_each(Visit visit) const noexcept {
        for (Index i = 0; i < n; ++i) {
            for (Offset e = start[i]; e < start[i + 1]; ++e) visit(i, column[e], e);
        }
    }
};

// coarse = P^T fine P, P the map from cells to merged cells: conductances between two merged cells are summed, as are the
// faces between them and the row sums of what is inside one, whose couplings vanish. cell_of [fine.n] -> 0 .. n-1; last [n]:
// working space. coarse must have room for n rows and as many entries as `fine` has.
void contract(SymmetricRows const& fine, Span<const Index> cell_of, Index n, Span<Offset> last, SymmetricRows& coarse) noexcept;

}  // namespace harmorph
