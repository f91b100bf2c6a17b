// The dense kernels of one instruction set as function tables. A strip consists of the pivots first
// .. end-1. `columns` are the panel's own or those of the border; the kernel works on from .. to-1
// of them. tests/dense/test_dense.cpp covers this file.
#pragma once

#include "dense/dense.hpp"

namespace harmorph::dense {

// Kernels for factorisation and substitution of a panel of real numbers (one plane) or complex
// numbers (two planes).
template <Index planes>
struct FrontKernels {
    // Subtracts the products of earlier strips from the rows of the strip.
    void (*subtract_earlier)(Slabs const& own, Slabs const& columns, Index first, Index end,
                             Index from, Index to) noexcept;
    // Sums rows from .. to-1 of the strip over the columns after those of the strip; see TailSums.
    void (*sum_tails)(Panel const& panel, Index first, Index end, Index from, Index to,
                      TailSums& tails) noexcept;
    // Factors the columns of the strip. `sums` are those of all rows of the front; the sums of the
    // strip are multiplied by U^-H.
    Index (*factor_diagonal)(Panel const& panel, Index first, Index end, Real* sums,
                             TailSums& tails, Real floor, Real& min_pivot_ratio) noexcept;
    // Finishes other columns after factor_diagonal(), and subtracts their part from column_sums,
    // the sums of the rows with the same numbers.
    void (*finish_columns)(Panel const& panel, Slabs const& columns, Index first, Index end,
                           Index from, Index to, Real* sums, Real* column_sums) noexcept;
    // Updates the band of the update matrix that begins at row `first`. `sums` are the row sums of
    // the border.
    void (*update_band)(Panel const& panel, UpdateMatrix const& update, Index first,
                        const Real* sums) noexcept;

    // solve_strip_forward() solves for the pivots of a strip in the right-hand sides y.
    // subtract_forward() then subtracts the products of the solution from the rows from .. to-1 of
    // `rest`, which belong to `columns`.
    void (*solve_strip_forward)(Slabs const& own, Index first, Index end, Real* y,
                                Index row) noexcept;
    void (*subtract_forward)(Slabs const& columns, Index first, Index end, Real* y, Real* rest,
                             Index row, Index from, Index to) noexcept;
    // Subtracts the products of the rows of `rest` that belong to `columns`, from column `begin`
    // on, from the pivots from .. to-1. `ahead` is the distance, counted in numbers, between the
    // entry that is read and the entry that is prefetched.
    void (*subtract_backward)(Slabs const& columns, Index begin, Real* y, Real* rest, Index row,
                              Index from, Index to, Offset ahead) noexcept;
    void (*solve_strip_backward)(Slabs const& own, Index first, Index end, Real* y, Index row,
                                 Offset ahead) noexcept;
};

// Kernels that move numbers between fronts; see dense.hpp.
struct MoveKernels {
    void (*extend_add)(UpdateMatrix const& from, const Index* targets, Panel const& panel,
                       UpdateMatrix const& update) noexcept;
    void (*add_rows)(Index n, const Real* from, const Index* targets, Real* y,
                     Index length) noexcept;
    void (*copy_rows)(Index n, const Real* y, const Index* targets, Real* to,
                      Index length) noexcept;
    void (*gather)(Rows const& from, Index begin, Index n, Index behind, Real* y, Index row,
                   Index planes) noexcept;
    void (*scatter)(const Real* y, Index row, Index planes, Rows const& to, Index begin,
                    Index n) noexcept;
};

template <Index planes>
FrontKernels<planes> const& front_kernels(Kernel kernel) noexcept;
MoveKernels const& move_kernels(Kernel kernel) noexcept;

}  // namespace harmorph::dense
