// The Hermitian matrix of the unknowns in the order of elimination, and its columns of known values
// on the wall.
#pragma once

#include "base/executor.hpp"
#include "operators/symmetric_matrix.hpp"
#include "operators/unknowns.hpp"

namespace harmorph {

// Between the corners of a cell: side[k] from corner k to the next, across[k] of a quad from corner
// k to k + 2.
struct CellConductances {
    Real side[4] = {};
    Real across[2] = {};

    // Of all that end at a corner.
    template <Index corners>
    Real sum_at(Index k) const noexcept {
        Real const sides = side[(k + corners - 1) % corners] + side[k];
        return corners == 4 ? sides + across[k & 1] : sides;
    }
};
template <Index corners>
struct CellGroup;

// Rows begin .. end-1: those that one of several threads may write to.
struct RowRange {
    Index begin, end;
    bool contain(Index row) const noexcept {
        return static_cast<std::uint32_t>(row) - static_cast<std::uint32_t>(begin) <
               static_cast<std::uint32_t>(end - begin);
    }
};

// Row i stores the entries of later columns, the upper triangle; the lower triangle is the
// conjugate one and is not stored. A coupling is the entry of an unknown's row in the column of a
// dof on the wall, whose value is known: it belongs to the right-hand side. Entries in columns of
// fixed points are summed in fixed_value, as the values of these points are 0. Together with them
// the diagonal, entries and couplings of a row sum to 0 up to the rounding of the diagonal, so A F
// is a sum of differences along couplings. Where x and y are coupled, this holds before the dofs of
// slipping points are turned to the slip lines; one complex number of fixed_value then stands for
// both dofs of a point. fixed_value also has what is left of the sum where a coupling is between
// points that are turned differently.
struct Matrix : Unknowns {
    struct Sizes {
        Offset entries = 0;
        Index couplings = 0, fixed = 0;
        MatrixKind kind = MatrixKind::real;
        bool turns = false;  // sides of a passage
    };

    Index n = 0;
    Span<Real> diagonal;           // [n]
    Span<Real> row_sum;            // [n] sum of all entries of a row, the diagonal among them
    Span<Real> row_sum_imaginary;  // complex only
    Span<Offset> start;            // [n + 1]
    Span<Index> column;
    Span<Real> value;
    Span<Real> imaginary;        // complex only
    Span<Index> coupling_start;  // [components * wall points + 1]
    Span<Index> coupling_row;
    Span<Real> coupling_value;
    Span<Real> coupling_imaginary;
    Span<Index> fixed_row;  // rows of unknowns beside fixed or turned points, increasing, some
                            // repeated; first dofs only
    Span<Real> fixed_value;
    Span<Real> fixed_imaginary;
    static constexpr Index short_row =
        8;  // so many columns may be read from the first one of any row on

    static Sizes count(Graph const& graph, MatrixKind kind,
                       Periodicity const& periodicity) noexcept;
    void lay_out(Arena& arena, Index n_points, Index unknowns, Index wall_points,
                 Sizes const& sizes) noexcept;
    // Shortens arrays that have been laid out for more than these counts.
    void fit(Index unknowns, Index wall_points, Sizes const& sizes) noexcept;
    // The sparsity pattern. slot [n_points]: number on the wall, or none; order [n]: the unknown at
    // each position of the elimination; position [n]: the inverse; tangent [n_points]: of slip
    // lines, coupled x and y only. With a rotation the matrix must be complex.
    void build(Span<const Index> representative, Graph const& graph, Span<const Index> order,
               Span<const Index> position, Span<const Index> slot, Span<const Vec2> tangent,
               Periodicity const& periodicity) noexcept;

    void clear() const noexcept;
    void clear_rows(RowRange rows) const noexcept;  // diagonal, row sum and entries
    void clear_known() const noexcept;              // couplings to the wall and to fixed points
    // Adds a conductance between two points: + on both diagonals, - off them. Points that are not
    // unknown have known values. Two points with one common unknown, as across a periodic pair one
    // cell apart, add nothing. Real matrices only.
    void add(Index point, Index other, Real conductance) const noexcept;
    // Adds the conductances between the corners of cells begin .. end-1 of a group, and a
    // circulation, `half` times the conductivity, along each side: + i circulation in the row of
    // the side's first corner, - i in that of the next corner; no circulation in a real matrix.
    // Writes only to the rows in range: threads with other ranges may go through the same cells,
    // and every row is added to in the order of the cells.
    template <bool with_circulation, Index corners>
    void add_corners(RowRange rows, CellGroup<corners> const& cells, Index begin, Index end,
                     Real half) const noexcept;
    // What add_corners() leaves out where corners of the cell are turned differently; complex
    // matrices only.
    void add_turns(RowRange rows, Cell const& cell, CellConductances const& conductance,
                   Real circulation) const noexcept;
    // The same between two points where x and y are coupled.
    void add_coupled(RowRange rows, Index point, Index other, Real conductance,
                     Real circulation) const noexcept;
    // Adds a conductance without the diagonals, and a circulation from i to j: rows as row_of has
    // them.
    template <bool with_circulation>
    void add_off_diagonal(RowRange rows, Index i, Index j, Real conductance,
                          Real circulation) const noexcept;
    // Has the cell an unknown in range? A cell without unknowns concerns the first range.
    template <Index n_components>
    bool concerns(RowRange rows, Cell const& cell) const noexcept;
    // body(range, rows) for ranges that together are all rows, one range for each thread. Returns
    // the number of ranges.
    template <class Body>
    Index for_row_ranges(Executor const& executor, Body const& body) const noexcept {
        constexpr Index least = 4096;  // rows that are worth a pass through all cells
        Index const n_ranges =
            executor.is_serial() ? 1 : clamp(n / least, Index{1}, executor.n_threads);
        auto const bound = [&](Index i) { return static_cast<Index>(Offset{n} * i / n_ranges); };
        executor.for_each(n_ranges, [&](Index range) {
            body(range, RowRange{bound(range), bound(range + 1)});
        });
        return n_ranges;
    }

    // The rows and columns of the unknowns, of a real matrix; faces [entries] tells which entries
    // are mesh edges.
    void mark_faces(Edges const& edges, Span<std::uint8_t> faces) const noexcept;
    SymmetricRows rows(Span<std::uint8_t> faces) const noexcept {
        return {n, diagonal, row_sum, start, column, value, faces};
    }

private:
    // The stored entry of two dofs; value is null if neither is an unknown in range.
    struct Entry {
        Real* value = nullptr;
        Real* imaginary = nullptr;
        bool turned = false;  // stored in the row of the second dof: the conjugate is wanted
    };
    Entry entry(RowRange rows, Index i, Index j) const noexcept;
    // Is the point an unknown, and the other one fixed, or slipping along another line?
    bool is_beside_fixed(Index point, Index other) const noexcept;
    bool stands_for_fixed(Index dof, Index other_dof) const noexcept;
    // The same for a cell of which some corners are no unknowns in range, or two are the same.
    template <bool with_circulation, Index corners>
    void add_beside_known(RowRange rows, Index const (&at)[corners], CellConductances conductance,
                          Real circulation) const noexcept;
    void add_turn(RowRange rows, Index point, Index other, Vec2 entry) const noexcept;
    void couple_to_fixed(RowRange rows, Index point, Real conductance,
                         Real circulation) const noexcept;
};

}  // namespace harmorph
