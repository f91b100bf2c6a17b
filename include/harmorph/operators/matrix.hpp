// The Hermitian matrix of the unknowns in the order of elimination, and its columns of known values on the wall.
#pragma once

#include "harmorph/ordering/symbolic.hpp"
#include "harmorph/operators/symmetric_matrix.hpp"
#include "harmorph/base/value_kind.hpp"
#include "harmorph/boundary/moving_boundary.hpp"

namespace harmorph {

// What the unknowns are, and so what an entry is.
//   real       one real number for a point: operators that move x and y alike
//   complex    one complex number for a point: the conformal operator
//   coupled_xy  two real numbers for a point, one where it slips: any operator where x and y are coupled by slip lines
enum class MatrixKind : std::int32_t { real, complex, coupled_xy };

// Between the corners of a cell: side[k] from corner k to the next, across[k] of a quad from corner k to k + 2.
struct CellConductances {
    Real side[4] = {};
    Real across[2] = {};
};

// Rows begin .. end-1, what one of several threads may write to.
struct RowRange {
    Index begin, end;
    bool contain(Index row) const noexcept {
        return static_cast<std::uint32_t>(row) - static_cast<std::uint32_t>(begin) < static_cast<std::uint32_t>(end - begin);
    }
};

// Row i holds its entries in later columns; below the diagonal stand their conjugates, which are implied. A coupling is the
// entry of an unknown's row in the column of a line of the wall: it belongs to the right-hand side. What couples an unknown
// to points that are fixed is summed, as all values of those are 0. With it a row's entries, couplings and diagonal sum to 0,
// but for the rounding of the diagonal, and A F is a sum of differences along couplings. Where x and y are coupled, that is so
// at a point before points that slip are turned to their lines; a complex number of fixed_value stands for both lines.
struct Matrix {
    struct Sizes {
        Offset entries = 0;
        Index couplings = 0, fixed = 0;
        MatrixKind kind = MatrixKind::real;
    };

    Index n = 0;
    MatrixKind kind = MatrixKind::real;
    Span<Index> row_of;          // [components * n_points] row of an unknown; wall(line of the wall); none where F = 0
    Span<Real> diagonal;         // [n]
    Span<Real> row_sum;          // [n] of all entries, the diagonal among them
    Span<Real> row_sum_imaginary; // complex only
    Span<Offset> start;          // [n + 1]
    Span<Index> column;
    Span<Real> value;
    Span<Real> imaginary;        // complex only
    Span<Index> coupling_start;  // [components * wall points + 1]
    Span<Index> coupling_row;
    Span<Real> coupling_value;
    Span<Real> coupling_imaginary;
    Span<Index> fixed_row;       // rows of unknowns beside fixed points, increasing, some repeated; of coupled x and y the first
    Span<Real> fixed_value;
    Span<Real> fixed_imaginary;
    Span<Vec2> frame;            // [n_points] coupled x and y only: direction of a point's first line; its second is normal to it

    Index components() const noexcept { return kind == MatrixKind::coupled_xy ? 2 : 1; }
    bool is_complex() const noexcept { return kind == MatrixKind::complex; }
    Index planes() const noexcept { return is_complex() ? 2 : 1; }

    static constexpr Index short_row = 8;  // entries: columns that may be read from any row's first on

    static constexpr Index wall(Index line) noexcept { return -2 - line; }  // its own inverse
    static constexpr bool is_wall(Index row) noexcept { return row <= -2; }

    static Sizes count(Graph const& graph, MatrixKind kind) noexcept {
        return {graph.start[graph.n] / 2, graph.couplings, graph.fixed, kind};
    }
    void lay_out(Arena& arena, Index n_points, Index unknowns, Index wall_points, Sizes const& sizes) noexcept;
    // The pattern. slot [n_points]: number on the wall, or none; position [n]: of each unknown; tangent [n_points] of slip
    // lines, coupled x and y only.
    void build(Span<const Index> representative, Graph const& graph, Span<const Index> order, Span<const Index> position,
               Span<const Index> slot, Span<const Vec2> tangent) noexcept;

    void clear() const noexcept;
    // A conductance between two points: + on both diagonals, - off them. Points that are not unknown have known values.
    // One unknown at both, as across a periodic pair one cell apart, has no difference that could flow. Real matrices only.
    void add(Index point, Index other, Real conductance) const noexcept;
    // Those of a cell's corners, and a circulation along each of its sides: + i circulation in the row of the corner it
    // leaves, - i in that of the next; none in a real matrix. Nothing but the rows in range is written to: threads with other
    // ranges may go through the same cells, and every row is added to in the order of the cells.
    template <bool with_circulation, Index corners>
    void add_corners(RowRange rows, Cell const& cell, CellConductances its, Real circulation) const noexcept;
    // The same between two points, where each has two lines.
    void add_lines(RowRange rows, Index point, Index other, Real conductance, Real circulation) const noexcept;
    // All of a conductance but the diagonals, between two rows as row_of has them, and of a circulation from the first to the second.
    template <bool with_circulation>
    void add_off_diagonal(RowRange rows, Index i, Index j, Real conductance, Real circulation) const noexcept;
    // Has the cell an unknown in range? One that has none at all concerns the first range.
    bool concerns(RowRange rows, Cell const& cell) const noexcept;
    // body(range, rows) for ranges that together are all rows, one for each thread. Returns how many there are.
    template <class Body>
    Index for_row_ranges(Executor const& executor, Body const& body) const noexcept {
        constexpr Index least = 4096;  // rows that are worth a pass through all cells
        Index const n_ranges = executor.is_serial() ? 1 : clamp(n / least, Index{1}, executor.n_threads);
        auto const bound = [&](Index i) { return static_cast<Index>(Offset{n} * i / n_ranges); };
        executor.for_each(n_ranges, [&](Index range) { body(range, RowRange{bound(range), bound(range + 1)}); });
        return n_ranges;
    }

    // Two points that slip on different lines: neither moves across its line, so each is fixed in the other's direction.
    bool turns(Index point, Index other) const noexcept {
        return frame[point].x != frame[other].x || frame[point].y != frame[other].y;
    }

    // The unknowns' part of a real matrix; faces [entries] tells which of its entries are mesh edges.
    void mark_faces(Edges const& edges, Span<std::uint8_t> faces) const noexcept;
    SymmetricRows rows(Span<std::uint8_t> faces) const noexcept {
        return {n, diagonal, row_sum, start, column, value, faces};
    }

private:
    // Where two lines meet; nowhere (value null) if neither is unknown.
    struct Entry {
        Real* value = nullptr;
        Real* imaginary = nullptr;
        bool turned = false;  // it stands for the second's row
    };
    Entry entry(RowRange rows, Index i, Index j) const noexcept;
    bool slips(Index point) const noexcept { return row_of[2 * point] >= 0 && row_of[2 * point + 1] == none; }
    // Is the point an unknown, and the other one fixed, or slipping on another line?
    bool is_beside_fixed(Index point, Index other) const noexcept;
    bool stands_for_fixed(Index line, Index other_line) const noexcept;
    void couple_to_fixed(RowRange rows, Index point, Real conductance, Real circulation) const noexcept;
};

}  // namespace harmorph
