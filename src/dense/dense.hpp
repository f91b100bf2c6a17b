// dense: partial Cholesky factorisation of the dense fronts of the direct engine, and substitution
// with the factor.
//
// Input: panels and update matrices (below), and right-hand sides. Output: the factored panel, the
// update matrix for the parent front, and solutions. dense.cpp divides the work among threads.
// dense_tiles (sums in registers, products) and dense_kernel (row sums, factorisation,
// substitution, extend-add, gather, scatter) are compiled for each instruction set.
//
// Matrices are stored in slabs. A slab is eight columns side by side, row after row, so that
// kernels read memory aligned and in order, and no numbers have to be packed. A slab that meets the
// diagonal ends below the diagonal block. The last slab is padded with zero columns.
//
//          pivots          border
//         0   1   2     0    1    2
//       +---+---+---+ +----+----+----+
//       | I |   |   | |    |    |    |    The panel of a front holds the rows of the pivots.
//       +---+---+---+ |    |    |    |    Factorisation replaces it by the upper factor U,
//           | I |   | |    |    |    |    A = U^H U. Each diagonal block I is the inverse of the
//           +---+---+ |    |    |    |    conjugate transpose of the block of U, so that solves
//               | I | |    |    |    |    are products. I is a lower triangle with zeros above.
//               +---+ +----+----+----+
//
// Diagonal entries are not stored; in their place is the row sum, A 1. A diagonal entry is the row
// sum minus the other entries of the row. For an M-matrix (off-diagonal entries not positive, row
// sums not negative) no digits cancel, and every entry of the factor has a small relative error
// however widely the coefficients vary. Source: W. K. Grassmann, M. I. Taksar, D. P. Heyman, Oper.
// Res. 33 (1985) 1107; A. S. Alfa, J. Xue, Q. Ye, Math. Comp. 71 (2002) 217.
//
// Numbers are real (one plane) or complex (two planes). A row of a slab consists of the real parts,
// followed by the imaginary parts, and so does a row of right-hand sides. Entries count the numbers
// of one plane.
#pragma once

#include "base/executor.hpp"
#include "base/span.hpp"
#include "simd/cpu.hpp"

namespace harmorph::dense {

// A slab has this many columns, a diagonal block this many pivots, and rows of right-hand sides are
// padded to a multiple of this number.
inline constexpr Index slab = 8;
constexpr Index slabs_of(Index n) noexcept { return (n + slab - 1) / slab; }
constexpr Index padded(Index n) noexcept { return slabs_of(n) * slab; }

// Returns the entry at which slab `number` begins. The first `shorter` slabs end below their
// diagonal blocks; all others have all rows.
constexpr Offset slab_start(Index rows, Index shorter, Index number) noexcept {
    Offset const below = number < shorter ? number : shorter;
    return slab * (slab * (below * (below + 1) / 2) + Offset{rows} * (number - below));
}
constexpr Offset triangle_entries(Index n) noexcept { return slab_start(n, n / slab, slabs_of(n)); }
constexpr Offset update_entries(Index n) noexcept { return triangle_entries(n); }
constexpr Offset panel_entries(Index pivots, Index border) noexcept {
    return triangle_entries(pivots) + slab_start(pivots, 0, slabs_of(border));
}
// Returns the number of entries in the row sums of a front: the pivots, then the border.
constexpr Offset sum_entries(Index pivots, Index border) noexcept {
    return padded(pivots) + padded(border);
}
// One block of the products has at most `strip` rows and `chunk` columns, so that the operands stay
// in the caches. `strip` and `chunk` are whole numbers of tiles.
inline constexpr Index strip = 128;
inline constexpr Index chunk = 192;

struct Slabs {
    Real* data = nullptr;
    Index rows = 0;
    Index columns = 0;
    Index shorter = 0;
    Index planes = 1;

    // Returns the place of the real part of an entry; the imaginary part is `slab` numbers further
    // on.
    Real* at(Index row, Index column) const noexcept {
        Index const number = column / slab;
        Offset const start = slab_start(rows, shorter, number) + Offset{slab} * row;
        return data + planes * start + (column - number * slab);
    }
    Offset rows_of_slab(Index number) const noexcept {
        return number < shorter ? Offset{slab} * (number + 1) : rows;
    }
};

constexpr Slabs triangle(Real* data, Index n, Index planes) noexcept {
    return {data, n, n, n / slab, planes};
}

struct Panel {
    Real* data = nullptr;
    Index pivots = 0;
    Index border = 0;
    Index planes = 1;

    Slabs own() const noexcept { return triangle(data, pivots, planes); }
    Slabs border_columns() const noexcept {
        return {data + planes * triangle_entries(pivots), pivots, border, 0, planes};
    }
    Index front() const noexcept { return pivots + border; }
    // Returns the distance between the real and the imaginary parts of the front's row sums.
    Offset sums_plane() const noexcept { return sum_entries(pivots, border); }
    // Returns where the row sums of the border begin.
    Index border_sums() const noexcept { return padded(pivots); }
    // The front has the columns of the pivots, then the columns of the border.
    Real* at(Index pivot, Index column) const noexcept {
        return column < pivots ? own().at(pivot, column)
                               : border_columns().at(pivot, column - pivots);
    }
};

// The Hermitian matrix that a front passes to the parent front. The upper triangle is stored, with
// the row sums in place of the diagonal. The row sums contain what this front and the fronts below
// it contribute.
struct UpdateMatrix {
    Real* data = nullptr;
    Index n = 0;
    Index planes = 1;

    Slabs all() const noexcept { return triangle(data, n, planes); }
    Real* at(Index row, Index column) const noexcept { return all().at(row, column); }
};

// The caller's threads, planes * sum_entries() numbers for row sums, and the smallest ratio so far
// of a pivot to the sum of the magnitudes of the terms of which the pivot is the sum. The ratio is
// 1 if no digits cancelled.
struct Workers {
    Executor executor;
    Real* sums = nullptr;
    Real* min_pivot_ratio = nullptr;
};

// The rows of a strip are summed over the columns behind the strip: sum [plane][row] adds
// the entries, `size` adds the magnitudes of the real parts.
struct TailSums {
    Real sum[2][strip], size[strip];
};

// Factors the panel in place. Returns the first pivot whose ratio (see Workers) is not above
// `floor`, or none. Lowers *workers.min_pivot_ratio, and stores in workers.sums the row sums that
// update_border() needs.
Index factor(Kernel kernel, Panel const& panel, Real floor, Workers const& workers) noexcept;

// Subtracts U^H U, formed with the columns of the border, from the update matrix.
void update_border(Kernel kernel, Panel const& panel, UpdateMatrix const& update,
                   Workers const& workers) noexcept;

// Adds the update matrix of a child to the panel and to the update matrix of the parent. targets
// [from.n] contains the row of the parent front for each row of the child's update matrix, in
// increasing order.
void extend_add(Kernel kernel, UpdateMatrix const& from, const Index* targets, Panel const& panel,
                UpdateMatrix const& update) noexcept;

// Solves U^H y = y for the pivots, and subtracts the products of the solution from the rows of the
// border. y is [front x planes x row]; row is a multiple of slab.
void solve_forward(Kernel kernel, Panel const& panel, Real* y, Index row,
                   Executor const& executor) noexcept;
// Solves U y = y for the pivots; the solution in the rows of the border is known.
void solve_backward(Kernel kernel, Panel const& panel, Real* y, Index row,
                    Executor const& executor) noexcept;

// Copies the rows at positions begin .. begin+n-1 to rows of y, and fills the padding with zeros;
// `row` is a multiple of slab. The first of the `behind` rows that follow in memory are prefetched.
void gather(Kernel kernel, Rows const& from, Index begin, Index n, Index behind, Real* y, Index row,
            Index planes) noexcept;
// Copies rows of y back to positions begin .. begin+n-1.
void scatter(Kernel kernel, const Real* y, Index row, Index planes, Rows const& to, Index begin,
             Index n) noexcept;

// add_rows() adds n rows of `length` numbers, a multiple of slab, to the rows `targets` of y.
// copy_rows() copies these rows of y to `to`.
void add_rows(Kernel kernel, Index n, const Real* from, const Index* targets, Real* y,
              Index length) noexcept;
void copy_rows(Kernel kernel, Index n, const Real* y, const Index* targets, Real* to,
               Index length) noexcept;

}  // namespace harmorph::dense
