// The dense kernels of one instruction set as function tables. A strip consists of the pivots first
// .. end-1. `columns` are the panel's own or those of the border; the kernel works on from .. to-1
// of them. tests/dense/test_dense.cpp covers this file.
#pragma once

#include "dense/dense.hpp"

namespace harmorph::dense {

// Kernels for factorisation and substitution of a panel of real numbers (one plane) or complex
// numbers (two planes).
template <class Number, Index planes>
struct FrontKernels {
    // Subtracts the products of earlier strips from the rows of the strip.
    void (*subtract_earlier)(Slabs<Number> const& own, Slabs<Number> const& columns, Index first,
                             Index end, Index from, Index to) noexcept;
    // Sums rows from .. to-1 of the strip over the columns after those of the strip; see TailSums.
    void (*sum_tails)(Panel<Number> const& panel, Index first, Index end, Index from, Index to,
                      TailSums<Number>& tails) noexcept;
    // Factors the columns of the strip. `sums` are those of all rows of the front; the sums of the
    // strip are multiplied by U^-H.
    Index (*factor_diagonal)(Panel<Number> const& panel, Index first, Index end, Number* sums,
                             TailSums<Number>& tails, Number floor,
                             Number& min_pivot_ratio) noexcept;
    // Finishes other columns after factor_diagonal(), and subtracts their part from column_sums,
    // the sums of the rows with the same numbers.
    void (*finish_columns)(Panel<Number> const& panel, Slabs<Number> const& columns, Index first,
                           Index end, Index from, Index to, Number* sums,
                           Number* column_sums) noexcept;
    // Updates the band of the update matrix that begins at row `first`. `sums` are the row sums of
    // the border.
    void (*update_band)(Panel<Number> const& panel, UpdateMatrix<Number> const& update, Index first,
                        const Number* sums) noexcept;

    // solve_strip_forward() solves for the pivots of a strip in the right-hand sides y.
    // subtract_forward() then subtracts the products of the solution from the rows from .. to-1 of
    // `rest`, which belong to `columns`.
    void (*solve_strip_forward)(Slabs<Number> const& own, Index first, Index end, Number* y,
                                Index row) noexcept;
    void (*subtract_forward)(Slabs<Number> const& columns, Index first, Index end, Number* y,
                             Number* rest, Index row, Index from, Index to) noexcept;
    // Subtracts the products of the rows of `rest` that belong to `columns`, from column `begin`
    // on, from the pivots from .. to-1. `ahead` is the distance, counted in numbers, between the
    // entry that is read and the entry that is prefetched.
    void (*subtract_backward)(Slabs<Number> const& columns, Index begin, Number* y, Number* rest,
                              Index row, Index from, Index to, Offset ahead) noexcept;
    void (*solve_strip_backward)(Slabs<Number> const& own, Index first, Index end, Number* y,
                                 Index row, Offset ahead) noexcept;
};

// Kernels that move numbers between fronts; see dense.hpp.
template <class Number>
struct MoveKernels {
    void (*extend_add)(UpdateMatrix<Number> const& from, const Index* targets,
                       Panel<Number> const& panel, UpdateMatrix<Number> const& update) noexcept;
    void (*add_rows)(Index n, const Number* from, const Index* targets, Number* y,
                     Index length) noexcept;
    void (*copy_rows)(Index n, const Number* y, const Index* targets, Number* to,
                      Index length) noexcept;
};

// Kernels that move numbers between fronts and rows of values; see dense.hpp.
template <class Number, class Value>
struct CopyKernels {
    void (*gather)(RowsOf<Value> const& from, Index begin, Index n, Index behind, Number* y,
                   Index row, Index planes) noexcept;
    void (*scatter)(const Number* y, Index row, Index planes, RowsOf<Value> const& to, Index begin,
                    Index n) noexcept;
};

// The tables below exist for double and float; values are doubles, or floats if the numbers are
// floats.
template <class Number, Index planes>
FrontKernels<Number, planes> const& front_kernels(Kernel kernel) noexcept;
template <class Number>
MoveKernels<Number> const& move_kernels(Kernel kernel) noexcept;
template <class Number, class Value>
CopyKernels<Number, Value> const& copy_kernels(Kernel kernel) noexcept;

}  // namespace harmorph::dense
