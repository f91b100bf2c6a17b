// A symmetric sparse matrix of which one triangle is stored, and the Galerkin contraction of merged
// cells, which adds their rows.
#pragma once

#include "base/arena.hpp"

namespace harmorph {

// Row i stores the entries in later columns, as Matrix does, and the row sum, which couples the
// cell to known values. In thin cells couplings differ by a factor of 1e14. The off-diagonal
// entries and the row sum determine accurately what depends on small couplings; the diagonal does
// not, as its rounding error is larger than they are (M. Dailey, F. M. Dopico, Q. Ye, Relative
// perturbation theory for diagonally dominant matrices). So products are sums of fluxes, (A x)_i =
// row_sum_i x_i + sum of a_ij (x_j - x_i), which are exactly 0 for constant x if the row sum is 0,
// and a contraction adds row sums. `faces` counts the mesh edges between the two cells (255 means
// 255 or more); the count is 0 for the diagonals of quads, which couple cells that do not touch.
struct SymmetricRows {
    Index n = 0;
    Span<Real> diagonal;  // [n] The row sum minus the sum of the row's off-diagonal entries.
    Span<Real> row_sum;   // [n]
    Span<Offset> start;   // [n + 1]
    Span<Index> column;
    Span<Real> value;
    Span<std::uint8_t> faces;

    void lay_out(Arena& arena, Index rows, Offset entries) noexcept;
    Offset entries() const noexcept { return start[n]; }

    // Calls visit(row, column, entry) once for each pair.
    template <class Visit>
    void for_each(Visit visit) const noexcept {
        for (Index i = 0; i < n; ++i) {
            for (Offset e = start[i]; e < start[i + 1]; ++e) visit(i, column[e], e);
        }
    }
};

// The imaginary parts of a Hermitian matrix, whose real parts are SymmetricRows; empty for a
// real matrix.
struct ImaginaryRows {
    Span<const Real> row_sum;  // [n]
    Span<const Real> value;    // [entries]
};

// Computes coarse = P^T fine P, where P is the piecewise constant prolongation from merged cells to
// cells: conductances and faces between two merged cells are summed, couplings inside a merged cell
// vanish, and row sums are added. Entries that are 0 and join no faces are omitted, for example
// those between movements along x and y if no point slips. cell_of [fine.n] has numbers 0 .. n-1;
// last [n] is working space. coarse must have room for n rows and as many entries as `fine` has.
void contract(SymmetricRows const& fine, Span<const Index> cell_of, Index n, Span<Offset> last,
              SymmetricRows& coarse) noexcept;

}  // namespace harmorph
