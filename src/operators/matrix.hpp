// The Hermitian matrix of the unknowns in the order of elimination, and the columns of the known
// values on the wall. tests/operators/test_matrix.cpp covers this file.
#pragma once

#include "base/executor.hpp"
#include "operators/symmetric_matrix.hpp"
#include "operators/unknowns.hpp"

namespace harmorph {

// Conductances between the corners of a cell: side[k] from corner k to the next, across[k] from
// corner k to k + 2 of a quad.
struct CellConductances {
    Real side[4] = {};
    Real across[2] = {};

    // Returns the sum of the conductances that end at a corner.
    template <Index corners>
    Real sum_at(Index k) const noexcept {
        Real const sides = side[(k + corners - 1) % corners] + side[k];
        return corners == 4 ? sides + across[k & 1] : sides;
    }
};
template <Index corners>
struct CellGroup;

// Rows begin .. end-1, to which one of several threads may write.
struct RowRange {
    Index begin, end;
    bool contain(Index row) const noexcept {
        return static_cast<std::uint32_t>(row) - static_cast<std::uint32_t>(begin) <
               static_cast<std::uint32_t>(end - begin);
    }
};

// Row i stores the entries of later columns, the upper triangle; the lower triangle is the
// conjugate one and is not stored. A coupling is the entry of an unknown's row in the column of a
// dof on the wall; the value of this dof is known, so the coupling belongs to the right-hand side.
// Entries in columns of fixed points are summed in fixed_value, as the values of these points are
// 0. Including these sums, the diagonal, the entries and the couplings of a row add up to 0, up to
// the rounding of the diagonal. Therefore A F is a sum of differences along couplings. If x and y
// are coupled, this holds before the dofs of slipping points are rotated to the slip lines; one
// complex number of fixed_value then represents both dofs of a point. fixed_value also contains the
// rest of the sum if points that are rotated differently are coupled.
struct Matrix : Unknowns {
    struct Sizes {
        Offset entries = 0;
        Index couplings = 0, fixed = 0;
        MatrixKind kind = MatrixKind::real;
        bool rotates = false;  // The sides of a passage are rotated.
    };

    Index n = 0;
    Span<Real> diagonal;           // [n]
    Span<Real> row_sum;            // [n] The sum of all entries of a row, including the diagonal.
    Span<Real> row_sum_imaginary;  // In complex matrices only.
    Span<Offset> start;            // [n + 1]
    Span<Index> column;
    Span<Real> value;
    Span<Real> imaginary;        // In complex matrices only.
    Span<Index> coupling_start;  // [components * wall points + 1]
    Span<Index> coupling_row;
    Span<Real> coupling_value;
    Span<Real> coupling_imaginary;
    // The rows of unknowns beside fixed or rotated points, increasing, with repetitions; first dofs
    // only.
    Span<Index> fixed_row;
    Span<Real> fixed_value;
    Span<Real> fixed_imaginary;
    // So many columns may be read from the first column of any row on.
    static constexpr Index short_row = 8;

    static Sizes count(Graph const& graph, MatrixKind kind,
                       Periodicity const& periodicity) noexcept;
    void lay_out(Arena& arena, Index n_points, Index unknowns, Index wall_points,
                 Sizes const& sizes) noexcept;
    // Shortens arrays that have been laid out for larger counts than these.
    void fit(Index unknowns, Index wall_points, Sizes const& sizes) noexcept;
    // Builds the sparsity pattern. slot [n_points] is the number on the wall, or none; order [n] is
    // the unknown at each position of the elimination; position [n] is the inverse of order;
    // tangent [n_points] has the tangents of slip lines, for coupled x and y only. With a rotation
    // the matrix must be complex.
    void build(Span<const Index> representative, Graph const& graph, Span<const Index> order,
               Span<const Index> position, Span<const Index> slot, Span<const Vec2> tangent,
               Periodicity const& periodicity) noexcept;

    void clear() const noexcept;
    void clear_rows(RowRange rows) const noexcept;  // Clears diagonal, row sum and entries.
    void clear_known() const noexcept;  // Clears couplings to the wall and to fixed points.
    // Adds a conductance between two points: + on both diagonals, - off them. Points that are not
    // unknown have known values. Two points with one common unknown, as across a periodic pair one
    // cell apart, add nothing. For real matrices only.
    void add(Index point, Index other, Real conductance) const noexcept;
    // Adds the conductances between the corners of cells begin .. end-1 of a group, and a
    // circulation along each side, which is `circulation_factor` times the conductivity: + i
    // circulation in the row of the side's first corner, - i in the row of the next corner. A real
    // matrix has no circulation. The function writes only to the rows in the range: threads with
    // other ranges may visit the same cells, and cells are added to every row in the order of the
    // cells.
    template <bool with_circulation, Index corners>
    void add_corners(RowRange rows, CellGroup<corners> const& cells, Index begin, Index end,
                     Real circulation_factor) const noexcept;
    // Adds the terms that add_corners() omits if corners of the cell are rotated differently; for
    // complex matrices only.
    void add_rotations(RowRange rows, Cell const& cell, CellConductances const& conductance,
                       Real circulation) const noexcept;
    // Adds a conductance and a circulation between two points if x and y are coupled.
    void add_coupled(RowRange rows, Index point, Index other, Real conductance,
                     Real circulation) const noexcept;
    // Adds a conductance without the diagonals, and a circulation from i to j, which are rows as
    // row_of() returns them.
    template <bool with_circulation>
    void add_off_diagonal(RowRange rows, Index i, Index j, Real conductance,
                          Real circulation) const noexcept;
    // Tells whether the cell has an unknown in the range. A cell without unknowns belongs to the
    // first range.
    template <Index n_components>
    bool concerns(RowRange rows, Cell const& cell) const noexcept;
    // Calls body(range, rows) for ranges that together are all rows, one range for each thread.
    // Returns the number of ranges.
    template <class Body>
    Index for_row_ranges(Executor const& executor, Body const& body) const noexcept {
        // A range needs at least so many rows, as each range takes a pass through all cells.
        constexpr Index min_rows = 4096;
        Index const n_ranges =
            executor.is_serial() ? 1 : clamp(n / min_rows, Index{1}, executor.n_threads);
        auto const bound = [&](Index i) { return static_cast<Index>(Offset{n} * i / n_ranges); };
        executor.for_each(n_ranges, [&](Index range) {
            body(range, RowRange{bound(range), bound(range + 1)});
        });
        return n_ranges;
    }

    // Marks in faces [entries] the entries of a real matrix that are mesh edges. rows() returns the
    // rows and columns of the unknowns with these marks.
    void mark_faces(Edges const& edges, Span<std::uint8_t> faces) const noexcept;
    SymmetricRows rows(Span<std::uint8_t> faces) const noexcept {
        return {n, diagonal, row_sum, start, column, value, faces};
    }
    ImaginaryRows imaginary_rows() const noexcept { return {row_sum_imaginary, imaginary}; }

private:
    void build_rows(Graph const& graph, Span<const Index> order,
                    Span<const Index> position) noexcept;
    void build_known_columns(Graph const& graph, Span<const Index> position, Span<const Index> slot,
                             Periodicity const& periodicity) noexcept;
    // The stored entry of two dofs; value is null if neither is an unknown in the range.
    struct Entry {
        Real* value = nullptr;
        Real* imaginary = nullptr;
        // The entry is stored in the row of the second dof, as the conjugate.
        bool is_conjugate = false;
    };
    Entry entry(RowRange rows, Index i, Index j) const noexcept;
    // Tells whether the point is an unknown, and the other one is fixed or slips along another
    // line.
    bool is_beside_fixed(Index point, Index other) const noexcept;
    bool stands_for_fixed(Index dof, Index other_dof) const noexcept;
    // Adds a cell if some corners are no unknowns in the range, or two corners are the same.
    template <bool with_circulation, Index corners>
    void add_beside_known(RowRange rows, Index const (&at)[corners], CellConductances conductance,
                          Real circulation) const noexcept;
    void add_rotation(RowRange rows, Index point, Index other, Vec2 entry) const noexcept;
    void couple_to_fixed(RowRange rows, Index point, Real conductance,
                         Real circulation) const noexcept;
};

}  // namespace harmorph
