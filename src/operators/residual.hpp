// Residuals b - A F of the solved functions: they tell how good an engine's solution is, and are
// the right-hand sides of iterative refinement.
#pragma once

#include "basis/basis.hpp"
#include "operators/matrix.hpp"
#include "basis/options.hpp"
#include "simd/cpu.hpp"
#include "base/row_view.hpp"
#include "ordering/subtree_ranges.hpp"

namespace harmorph {

// Values at all points as the equations see them: the numbers of a dof (matrix.hpp) stand side by
// side, one column for each right-hand side. They are the row of a point, or half a row where a
// point has two dofs. Of complex values all real parts come first, then all imaginary parts. A
// basis has rows while its functions are being solved; then they become blocks (RowsToBlocks).
struct DofValues {
    Span<Real> value;              // the rows of all points
    Span<const Index> of;          // [n] dof of each position
    Span<const Index> wall_point;  // points of the wall
    Index components;              // dofs of a point
    Index n_functions;             // of which a plane of a row has one number each
    Index first_function;          // number of the first one, for reports
    Index numbers;                 // of a dof
    // Rows like `value`: the part of the right-hand sides that does not come from the wall, whose
    // values are 0 then. Null: 0.
    const Real* source = nullptr;

    // The functions of a basis.
    DofValues(Basis const& basis, Span<const Index> dof_of, Index dofs_of_a_point) noexcept
        : value(basis.value),
          of(dof_of),
          wall_point(basis.wall_point),
          components(dofs_of_a_point),
          n_functions(basis.n_functions()),
          first_function(basis.header->counts.first_stored),
          numbers(basis.row_length() / components) {}
    // Vector fields: the row of a point has the x of all fields, then the y of all fields.
    DofValues(Span<Real> rows, Index first_field, Index n_fields, Span<const Index> dof_of,
              Span<const Index> wall, Index dofs_of_a_point) noexcept
        : value(rows),
          of(dof_of),
          wall_point(wall),
          components(dofs_of_a_point),
          n_functions(n_fields),
          first_function(first_field),
          numbers(2 * n_fields / components) {}

    Index length() const noexcept { return numbers; }
    Offset start_of(Index dof) const noexcept { return Offset{dof} * numbers; }
    Real* of_dof(Index dof) const noexcept { return value.data() + start_of(dof); }
    Real* at(Index position) const noexcept { return of_dof(of[position]); }
    const Real* source_at(Index position) const noexcept { return source + start_of(of[position]); }
    // The numbers of one point become those of another; of none: nothing to do.
    void copy_row(Index from, Index to) const noexcept {
        if (from == to || from == none) return;
        std::memcpy(of_dof(components * to), of_dof(components * from),
                    sizeof(Real) * static_cast<Size>(components * numbers));
    }
    Index columns(Matrix const& matrix) const noexcept {
        return matrix.is_complex() ? n_functions : length();
    }
    // The values of the unknowns by position, as engines see them.
    Rows rows(Matrix const& matrix) const noexcept {
        return {value.data(), of.data(), length(), columns(matrix), columns(matrix)};
    }
    // The values of a dof on the wall, by its number there (see Matrix::wall).
    Real* wall(Index dof) const noexcept {
        return of_dof(components * wall_point[dof / components] + dof % components);
    }
};

// Residuals of a few columns at a time, for all rows. They are sums of differences of values along
// couplings, not products with the diagonal: the strong couplings of thin cells would make the
// diagonal so large that its rounding hides the weak couplings (symmetric_matrix.hpp). Where x and
// y are coupled, they are sums of differences of displacements; the second dof of a slipping point
// is not used then, and is set at the very end of a solve. A row is summed in one go. Its entries
// left of the diagonal are stored in earlier rows; every earlier row waits in the list of the next
// row that it is coupled to, and so does every coupling to the wall. The rows of a subtree of the
// assembly tree wait for each other and for rows behind all subtrees: subtrees are summed at the
// same time.
struct Residual {
    static constexpr Index widest = 24;

    Index width = 6;                   // at most `widest`
    Kernel kernel = Kernel::baseline;  // any gives the same bits
    // [n x planes x width] rows by position: b - A F, real and then imaginary parts. Only one of
    // the two arrays exists, in the precision of the engine's factor.
    Span<Real> value;
    Span<float> single;  // residuals are computed in double and rounded last, so that corrections
                         // lose no accuracy
    Span<Index> latest;  // [n] not where x and y are coupled: what began to wait last for this row:
                         // a row, or n + number of a coupling; and
    Span<Index> next;    // [n + couplings] for each that waits the one that began before
    Span<Index> passed;  // [n] of each waiting row: its entries before the one that it waits with
    SubtreeRanges subtrees;  // the same for any number of threads; none: all rows are summed one
                             // after the other
    Executor executor;

    void lay_out(Arena& arena, Index unknowns, Index couplings, MatrixKind kind,
                 Index n_columns = 6, Precision precision = Precision::in_double) noexcept;
    // Chooses the subtrees of rows that are in the order of elimination of this tree.
    void share_out(AssemblyTree const& tree, Executor const& by) noexcept;
    // Of columns first .. first+n-1, n <= width: squared 2-norms of b and of b - A F.
    struct Norms {
        Real right_hand_side[widest] = {}, rest[widest] = {};
        // |b - A F| / |b|; the numerator alone where b is 0.
        Real relative(Index k) const noexcept;
        void add(Norms const& of_other_rows, Index n) noexcept;
    };
    Norms compute(Matrix const& matrix, DofValues const& dofs, Index first, Index n) const noexcept;
    // Computes the norms alone, n <= widest; not where x and y are coupled.
    Norms measure(Matrix const& matrix, DofValues const& dofs, Index first, Index n) const noexcept;
    // For one column: the maximum over all rows of |b - A F| / (sum of the row's |entries| times
    // the maximum of |F|). Rounding of F alone leaves about an epsilon. 2 <= width. Infinite where
    // a value is not a number.
    Real beside_entries(Matrix const& matrix, DofValues const& dofs, Index column) const noexcept;
    struct Choice {
        bool column[widest];
    };
    // Adds corrections, which stand in `value` or `single`, to the chosen ones of columns first ..
    // first+n-1 of F. Returns for each column the largest correction relative to the largest new
    // value.
    struct Changes {
        Real column[widest];
    };
    Changes add_to(Matrix const& matrix, DofValues const& dofs, Index first, Index n,
                   Choice const& chosen) const noexcept;
};

}  // namespace harmorph
