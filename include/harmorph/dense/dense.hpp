// Dense kernels of the direct engine. Matrices lie in slabs: eight columns side by side, row after row, so that whatever the
// kernels read is aligned and follows on, and nothing is ever packed. A slab that meets the diagonal ends below its diagonal
// block. The last columns are filled up with zeros.
//
//            pivots          border
//           0   1   2     0    1    2
//         +---+---+---+ +----+----+----+
//         | I |   |   | |    |    |    |    The panel of a front: its pivots' rows. Factored, it is the upper factor U
//         +---+---+---+ |    |    |    |    (A = U^H U), with each diagonal block replaced by the inverse of its conjugate
//             | I |   | |    |    |    |    transpose, so that solves are products. I: inverses (lower triangles, zeros
//             +---+---+ |    |    |    |    above).
//                 | I | |    |    |    |
//                 +---+ +----+----+----+
//
// Diagonals are never stored: in their places stand the sums of whole rows, A 1. A diagonal is what its row's other entries
// leave of the sum. Where those are negative and sums are not, as for conductances, nothing cancels, and the factor is
// exact to rounding in every entry however uneven the matrix is. Source: W. K. Grassmann, M. I. Taksar, D. P. Heyman, Oper.
// Res. 33 (1985) 1107; A. S. Alfa, J. Xue, Q. Ye, Math. Comp. 71 (2002) 217.
//
// Numbers are double or float, real (one plane) or complex (two planes): a slab's row is its real parts, then its imaginary
// parts; a row of right-hand sides likewise. Entries count numbers of one plane.
#pragma once

#include "harmorph/base/executor.hpp"
#include "harmorph/simd/cpu.hpp"
#include "harmorph/base/row_view.hpp"
#include "harmorph/base/span.hpp"

namespace harmorph::dense {

// Columns of a slab, pivots of a diagonal block, and what rows of right-hand sides are padded to a multiple of.
inline constexpr Index slab = 8;
constexpr Index slabs_of(Index n) noexcept { return (n + slab - 1) / slab; }
constexpr Index padded(Index n) noexcept { return slabs_of(n) * slab; }

// Where slab `number` begins, in entries: `shorter` slabs end below their diagonal blocks, all others have all rows.
constexpr Offset slab_start(Index rows, Index shorter, Index number) noexcept {
    Offset const below = number < shorter ? number : shorter;
    return slab * (slab * (below * (below + 1) / 2) + Offset{rows} * (number - below));
}
constexpr Offset triangle_entries(Index n) noexcept { return slab_start(n, n / slab, slabs_of(n)); }
constexpr Offset update_entries(Index n) noexcept { return triangle_entries(n); }
constexpr Offset panel_entries(Index pivots, Index border) noexcept {
    return triangle_entries(pivots) + slab_start(pivots, 0, slabs_of(border));
}
// Entries in the row sums of a front: the pivots', then the border's.
constexpr Offset sum_entries(Index pivots, Index border) noexcept { return padded(pivots) + padded(border); }
// Rows, and columns, that are worked on at a time, so that what they are multiplied by stays in the caches. Whole tiles.
inline constexpr Index strip = 128;
inline constexpr Index chunk = 192;

template <class Number>
struct Slabs {
    Number* data = nullptr;
    Index rows = 0;
    Index columns = 0;
    Index shorter = 0;
    Index planes = 1;

    // The entry's real part; its imaginary part is a slab's width further on.
    Number* at(Index row, Index column) const noexcept {
        Index const number = column / slab;
        Offset const start = slab_start(rows, shorter, number) + Offset{slab} * row;
        return data + planes * start + (column - number * slab);
    }
};

template <class Number>
constexpr Slabs<Number> triangle(Number* data, Index n, Index planes) noexcept {
    return {data, n, n, n / slab, planes};
}

template <class Number>
struct Panel {
    Number* data = nullptr;
    Index pivots = 0;
    Index border = 0;
    Index planes = 1;

    Slabs<Number> own() const noexcept { return triangle(data, pivots, planes); }
    Slabs<Number> of_border() const noexcept {
        return {data + planes * triangle_entries(pivots), pivots, border, 0, planes};
    }
    Index front() const noexcept { return pivots + border; }
    // From the front's row sums to their imaginary parts.
    Offset sums_plane() const noexcept { return sum_entries(pivots, border); }
    Index border_sums() const noexcept { return padded(pivots); }  // where the border's begin
    // Column of the front: its pivots, then its border.
    Number* at(Index pivot, Index column) const noexcept {
        return column < pivots ? own().at(pivot, column) : of_border().at(pivot, column - pivots);
    }
};

// The Hermitian matrix that a front leaves to its parent: the upper triangle; in its diagonal's place the row sums, this
// front's and its children's parts of them.
template <class Number>
struct UpdateMatrix {
    Number* data = nullptr;
    Index n = 0;
    Index planes = 1;

    Slabs<Number> all() const noexcept { return triangle(data, n, planes); }
    Number* at(Index row, Index column) const noexcept { return all().at(row, column); }
};

// The caller's threads, planes * sum_entries() numbers for row sums, and the least part that was left of what a pivot is
// summed of: 1 where nothing cancelled.
template <class Number>
struct Workers {
    Executor executor;
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

// Takes U^H U of the border's columns off the update matrix.
template <class Number>
void update_border(Kernel kernel, Panel<Number> const& panel, UpdateMatrix<Number> const& update,
                   Workers<Number> const& workers) noexcept;

// Adds a child's update matrix to its parent's panel and update matrix. targets [from.n]: its rows' places in the parent's
// front, increasing.
template <class Number>
void extend_add(Kernel kernel, UpdateMatrix<Number> const& from, const Index* targets, Panel<Number> const& panel,
                UpdateMatrix<Number> const& update) noexcept;

// y [front x planes x row], row a multiple of slab: solves U^H y = y for the pivots and takes them off the border's
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

// Adds n rows of `length` numbers, a multiple of slab, to rows of y.
template <class Number>
void add_rows(Kernel kernel, Index n, const Number* from, const Index* targets, Number* y, Index length) noexcept;

}  // namespace harmorph::dense
