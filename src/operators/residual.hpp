// Residuals b - A F of the solved functions measure the accuracy of an engine's solution, and are
// the right-hand sides of iterative refinement.
#pragma once

#include "base/span.hpp"
#include "basis/basis.hpp"
#include "basis/options.hpp"
#include "operators/matrix.hpp"
#include "ordering/subtree_ranges.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// The values at all points in the arrangement of the equations: the numbers of a dof (matrix.hpp)
// stand side by side, one column for each right-hand side: the row of a point, or half a
// row if a point has two dofs. For complex values all real parts come first, then all imaginary
// parts. A basis has rows while its functions are being solved; then they become blocks
// (RowsToBlocks).
struct DofValues {
    Span<Real> value;                   // The rows of all points.
    Span<const Index> dof_of_position;  // [n] The dof of each position.
    Span<const Index> wall_point;       // The points of the wall.
    Index components;                   // The number of dofs of a point.
    Index n_functions;                  // A plane of a row has one number for each function.
    Index first_function;               // The number of the first function, for reports.
    Index numbers;                      // The numbers of a dof.
    // Rows like those of `value` with the part of the right-hand sides that does not come from the
    // wall. Null means 0.
    const Real* source = nullptr;
    // [n] The number of each position's row in `source`, or none, for which the source is 0. If the
    // array is empty, `source` has the rows of all dofs.
    Span<const Index> source_row;
    // The values of unknowns are not right-hand sides but a first approximation; the right-hand
    // sides are those that the values on the wall make.
    bool is_start = false;

    // Views the functions of a basis.
    DofValues(Basis const& basis, Span<const Index> dof_at_position, Index n_dofs_of_point) noexcept
        : value(basis.value),
          dof_of_position(dof_at_position),
          wall_point(basis.wall_point),
          components(n_dofs_of_point),
          n_functions(basis.n_functions()),
          first_function(basis.header->counts.first_stored),
          numbers(basis.row_length() / components) {}
    // Views vector fields: the row of a point has the x of all fields, then the y of all fields.
    DofValues(Span<Real> rows, Index first_field, Index n_fields, Span<const Index> dof_at_position,
              Span<const Index> wall, Index n_dofs_of_point) noexcept
        : value(rows),
          dof_of_position(dof_at_position),
          wall_point(wall),
          components(n_dofs_of_point),
          n_functions(n_fields),
          first_function(first_field),
          numbers(2 * n_fields / components) {}

    Index length() const noexcept { return numbers; }
    Offset start_of(Index dof) const noexcept { return Offset{dof} * numbers; }
    Real* values_of_dof(Index dof) const noexcept { return value.data() + start_of(dof); }
    Real* at(Index position) const noexcept { return values_of_dof(dof_of_position[position]); }
    // Returns null if there is no source at the position.
    const Real* source_at(Index position) const noexcept {
        Index const number = source_row.empty() ? dof_of_position[position] : source_row[position];
        return source == nullptr || number == none ? nullptr : source + start_of(number);
    }
    // Copies the numbers of one point to another; does nothing if `from` is none.
    void copy_row(Index from, Index to) const noexcept {
        if (from == to || from == none) return;
        std::memcpy(values_of_dof(components * to), values_of_dof(components * from),
                    sizeof(Real) * static_cast<Size>(components * numbers));
    }
    Index columns(Matrix const& matrix) const noexcept {
        return matrix.is_complex() ? n_functions : length();
    }
    // Returns the values of the unknowns by position, in the form that engines take.
    Rows rows(Matrix const& matrix) const noexcept {
        return {value.data(), dof_of_position.data(), length(), columns(matrix), columns(matrix)};
    }
    // Returns the values of a dof on the wall, by its number there (see Matrix::wall).
    Real* wall(Index dof) const noexcept {
        return values_of_dof(components * wall_point[dof / components] + dof % components);
    }
};

// Residuals of a few columns at a time, for all rows: sums of differences of values along
// couplings, not products with the diagonal: the strong couplings of thin cells would make the
// diagonal so large that its rounding hides the weak couplings (symmetric_matrix.hpp). If x and y
// are coupled, residuals are sums of differences of displacements; the second dof of a slipping
// point is not used then, and is set at the very end of a solve. All terms of a row are added one
// after the other. The entries left of the diagonal are stored in earlier rows; every earlier row
// is in the list of the next row to which it is coupled, and so is every coupling to the wall. The
// rows of a subtree of the assembly tree are only in lists of the same subtree and of rows after
// all subtrees, so that subtrees are summed at the same time.
struct Residual {
    static constexpr Index max_width = 24;

    // The squared 2-norms of b and of b - A F for the columns first .. first+n-1.
    struct Norms {
        Real right_hand_side[max_width] = {}, rest[max_width] = {};
        // Returns |b - A F| / |b|, or the numerator alone if b is 0.
        Real relative(Index k) const noexcept;
    };

    Index width = 6;                   // The width is at most `max_width`.
    Kernel kernel = Kernel::baseline;  // All kernels give the same bits.
    // [n x planes x width] Rows by position: b - A F, real and then imaginary parts.
    Span<Real> value;
    // [n] The latest entry of each row's list: a row, or n + number of a coupling. The lists do not
    // exist if x and y are coupled.
    Span<Index> latest;
    Span<Index> next;  // [n + couplings] The entry of the same list before this one.
    // [n] For each listed row, the number of entries before the one by which the row is listed.
    Span<Index> passed;
    Span<Norms> norms_of_subtree;
    // The subtrees are the same for any number of threads; if there are none, all rows are summed
    // one after the other.
    SubtreeRanges subtrees;
    Executor executor;

    void lay_out(Arena& arena, Index unknowns, Index couplings, MatrixKind kind,
                 Index n_columns = 6) noexcept;
    // Chooses the subtrees; rows are in the order of elimination of this tree.
    void choose_subtrees(AssemblyTree const& tree, Executor const& by) noexcept;
    // Stores the residuals, n <= width.
    Norms compute(Matrix const& matrix, DofValues const& dofs, Index first, Index n) const noexcept;
    // Computes the norms alone, n <= max_width; not if x and y are coupled.
    Norms measure(Matrix const& matrix, DofValues const& dofs, Index first, Index n) const noexcept;
    // Returns the backward error of one column: the maximum over all rows of |b - A F| / (sum of
    // the row's |entries| times the maximum of |F|). Rounding of F alone leaves about an epsilon.
    // The width must be at least 2. The result is infinite if a value is not a number.
    Real backward_error(Matrix const& matrix, DofValues const& dofs, Index column) const noexcept;
    struct Choice {
        bool column[max_width];
    };
    // Adds corrections, which are in `value`, to the chosen ones of the columns first
    // .. first+n-1 of F. Returns for each column the largest correction relative to the largest new
    // value.
    struct Changes {
        Real column[max_width];
    };
    Changes add_to(Matrix const& matrix, DofValues const& dofs, Index first, Index n,
                   Choice const& chosen) const noexcept;
};

// Converts numbers of dofs into displacements of points, and back. Only this file and the matrix
// distinguish slipping points and rotated sides from others.
class DofDirections {
public:
    explicit DofDirections(Matrix const& matrix) noexcept : matrix_(matrix) {}

    // The dof of a slipping point is a movement along the tangent, which becomes movements along x
    // and y. To be called before points that are joined to slipping ones get the same
    // numbers.
    void rotate_slipping(DofValues const& values, Index n_points) const noexcept;
    void rotate_slipping_back(DofValues const& values, Index n_points) const noexcept;
    // The number of a dof on a side of a passage becomes the displacement of the point. To
    // be called after joined points have got the numbers of the points to which they are joined.
    void rotate_sides(DofValues const& values, Index n_points) const noexcept;
    void rotate_sides_back(DofValues const& values, Index n_points) const noexcept;

private:
    template <class Rotate>
    void for_each_slipping(DofValues const& values, Index n_points,
                           Rotate const& rotate) const noexcept;
    template <class Rotate>
    void for_each_rotated(DofValues const& values, Index n_points,
                          Rotate const& rotate) const noexcept;

    Matrix const& matrix_;
};

}  // namespace harmorph
