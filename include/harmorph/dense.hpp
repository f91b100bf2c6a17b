// Dense kernels of the direct engine, on row-major blocks. A front's panel holds its pivots' rows; factored, it is the upper
// factor U (A = U^H U), with each diagonal block of `block` pivots replaced by the inverse of its conjugate transpose, so that
// solves are products.
// Diagonals are never stored: in their places stand the sums of whole rows, A 1. A diagonal is what its row's other entries
// leave of the sum. Where those are negative and sums are not, as for conductances, nothing cancels, and the factor is
// exact to rounding in every entry however uneven the matrix is. Source: W. K. Grassmann, M. I. Taksar, D. P. Heyman, Oper.
// Res. 33 (1985) 1107; A. S. Alfa, J. Xue, Q. Ye, Math. Comp. 71 (2002) 217.
//
//             pivots         border
//           +----+-------+-----------+
//   strip 0 | I  |       |           |    Strips of at most `strip` pivots; a strip's rows begin at its first pivot, so that
//           +----+-------+-----------+    next to nothing below the diagonal is stored. I: inverses (lower triangles, zeros
//   strip 1      | I     |           |    above), one for each block.
//                +-------+-----------+
//
// Numbers are double or float, real (one plane) or complex (two planes): a row is its real parts, then, as many numbers
// further on, its imaginary parts. Entries count numbers of one plane.
#pragma once

#include "harmorph/executor.hpp"
#include "harmorph/processor.hpp"
#include "harmorph/rows.hpp"
#include "harmorph/span.hpp"

namespace harmorph::dense {

inline constexpr Index block = 8;
inline constexpr Index strip = 128;
// Kernels read, but never use or write, up to this many numbers behind the end of a block.
inline constexpr Offset overread = 64;
// Rows of right-hand sides are padded to a multiple of this.
inline constexpr Index row_multiple = 8;
constexpr Index padded(Index n) noexcept { return (n + row_multiple - 1) / row_multiple * row_multiple; }
// Working space for one thread.
inline constexpr Offset packing_entries = 2 * strip * strip;

// Where a panel's strip begins, in entries: strip * (front + (front - strip) + (front - 2 strip) + ...).
constexpr Offset strip_start(Index front, Index first) noexcept {
    return Offset{first} * front - Offset{first} * (first - strip) / 2;
}

template <class Number>
struct Panel {
    Number* data = nullptr;
    Index pivots = 0;
    Index front = 0;  // pivots + border
    Index planes = 1;

    Index border() const noexcept { return front - pivots; }
    // From a row's real parts to its imaginary parts.
    Offset plane(Index pivot) const noexcept { return front - pivot / strip * strip; }
    // A pivot's row, such that row[column] is the entry in a column of the front, column >= the strip's first pivot.
    Number* row(Index pivot) const noexcept {
        Index const first = pivot / strip * strip;
        return data + planes * (strip_start(front, first) + (pivot - first) * plane(first)) - first;
    }
};

constexpr Offset panel_entries(Index pivots, Index front) noexcept {
    Index const first = pivots / strip * strip;  // what is left is a strip of its own, or nothing
    return strip_start(front, first) + Offset{pivots - first} * (front - first);
}

// Where a band of an update matrix begins, in entries; strip is a multiple of the padding.
constexpr Offset band_start(Index n, Index first) noexcept { return strip_start(padded(n), first); }

// The Hermitian matrix that a front leaves to its parent: the upper triangle, in bands of `strip` rows that begin at their
// first row's diagonal. Rows are padded, so that they can be written in whole vectors.
template <class Number>
struct UpdateMatrix {
    Number* data = nullptr;
    Index n = 0;
    Index planes = 1;

    Offset plane(Index number) const noexcept { return padded(n - number / strip * strip); }
    // row[column] is the entry in a column, column >= the band's first row.
    Number* row(Index number) const noexcept {
        Index const first = number / strip * strip;
        return data + planes * (band_start(n, first) + (number - first) * plane(first)) - first;
    }
};

constexpr Offset update_entries(Index n) noexcept {
    Index const first = n / strip * strip;
    return band_start(n, first) + Offset{n - first} * padded(n - first);
}

// With what kernels read behind it.
constexpr Offset update_room(Index n) noexcept { return n > 0 ? update_entries(n) + overread : 0; }

// Where the rows of a matrix go in a front: ends[r] is the first row behind r's run of neighbouring targets, which does not
// lead from pivots to border.
struct Targets {
    Index* at = nullptr;
    Index* ends = nullptr;
};

// The caller's threads, planes * packing_entries numbers for each of them, planes * front numbers for row sums, and the
// least part that was left of what a pivot is summed of: 1 where nothing cancelled.
template <class Number>
struct Workers {
    Executor executor;
    Number* packing = nullptr;
    Number* sums = nullptr;
    Number* least_left = nullptr;
};

// Of a strip's rows, what is behind the strip's own columns: [plane][row] summed, and summed without signs.
template <class Number>
struct TailSums {
    Number sum[2][strip], size[strip];
};

// What follows is there for double and float.

// Factors in place. Returns the first pivot of which no more than `floor` is left, or none. Lowers *workers.least_left, and
// leaves in workers.sums what update_border() needs.
template <class Number>
Index factor(Kernel kernel, Panel<Number> const& panel, Number floor, Workers<Number> const& workers) noexcept;

// Takes U^H U of the border's columns off the update matrix. In its diagonal's place stand row sums, too: this front's and
// its children's parts of them.
template <class Number>
void update_border(Kernel kernel, Panel<Number> const& panel, UpdateMatrix<Number> const& update,
                   Workers<Number> const& workers) noexcept;

// Adds a child's update matrix to its parent's panel and update matrix.
template <class Number>
void extend_add(Kernel kernel, UpdateMatrix<Number> const& from, Targets const& targets, Panel<Number> const& panel,
                UpdateMatrix<Number> const& update) noexcept;

// y [front x planes x row], row a multiple of row_multiple: solves U^H y = y for the pivots and takes them off the border's
// rows.
template <class Number>
void solve_forward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row, Executor const& executor) noexcept;
// Solves U y = y for the pivots, the border's rows known.
template <class Number>
void solve_backward(Kernel kernel, Panel<Number> const& panel, Number* y, Index row, Executor const& executor) noexcept;

// Rows of y, with zeros in the padding, from the given positions: begin .. begin+n-1, or those of a list. `row` as above.
// Values are doubles, or floats where numbers are.
template <class Number, class Value>
void gather(Kernel kernel, RowsOf<Value> const& from, Index begin, Index n, Number* y, Index row, Index planes) noexcept;
template <class Number, class Value>
void gather(Kernel kernel, RowsOf<Value> const& from, Span<const Index> positions, Number* y, Index row,
            Index planes) noexcept;
// And back to positions begin .. begin+n-1.
template <class Number, class Value>
void scatter(Kernel kernel, const Number* y, Index row, Index planes, RowsOf<Value> const& to, Index begin,
             Index n) noexcept;

// Adds n rows of `length` numbers, a multiple of row_multiple, to rows of y.
template <class Number>
void add_rows(Kernel kernel, Index n, const Number* from, Targets const& targets, Number* y, Index length) noexcept;

}  // namespace harmorph::dense
