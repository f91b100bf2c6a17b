// The passes of conjugate gradients and of a cycle over the rows of a level, as a table of
// functions for each instruction set. tests/multigrid/test_cycle.cpp covers this file.
#pragma once

#include "base/kernel.hpp"
#include "multigrid/function_block.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// A level in the precision of the cycle: the rows of A = L + D + L^T, of which the entries in
// later columns are stored, and the interpolation P from the coarser level.
template <class Number>
struct CycleLevel {
    Index n = 0, n_coarse = 0;
    // The columns of a row are at most so many rows later.
    Index reach = 0;
    const Offset* start = nullptr;
    const Index* column = nullptr;
    const Number* value = nullptr;
    const Number* diagonal = nullptr;
    // These arrays do not exist on the last level.
    const Offset* by_start = nullptr;
    const Index* by_column = nullptr;
    const Number* by_weight = nullptr;
};

template <class Number>
struct CycleKernels {
    // p = z + beta p, and q = A p, flux by flux: row j loses what row i gains. Adds p.q, as a sum
    // of squares, to `energy`, and p.r to `along`.
    struct Product {
        const Real* row_sum;
        ImaginaryRows imaginary;
        Number beta[FunctionBlock::max_width];
        const Number *r, *z;
        Number *p, *q;
        Real energy[FunctionBlock::max_width], along[FunctionBlock::max_width];
    };
    void (*multiply)(CycleLevel<Number> const& level, Index width, Index planes,
                     Product& task) noexcept;

    // r -= step q, z = r, and x += factor p, where x are the values of the block. Adds the squares
    // of r to `squares`.
    struct Update {
        Number step[FunctionBlock::max_width];
        Real factor[FunctionBlock::max_width];
        const Number *p, *q;
        Number* r;
        Real squares[FunctionBlock::max_width];
        bool descends;  // The pass also does what descend() does for a level.
    };
    // These are the parts of symmetric Gauss-Seidel with a coarse correction in between, for a
    // start of 0, and a single array for the right-hand side and the result x:
    //   descend: x = (L + D)^-1 x; coarse = P^T (right-hand side - A x) = -P^T L^T x; x = D x;
    //   ascend:  x = (D + L^T)^-1 (x - L P coarse).
    void (*descend)(CycleLevel<Number> const& level, Index width, Number* x,
                    Number* coarse) noexcept;
    void (*update)(CycleLevel<Number> const& level, FunctionBlock const& block, Number* z,
                   Number* coarse, Update& task) noexcept;
    // Adds x.q to `product` if q is not null.
    void (*ascend)(CycleLevel<Number> const& level, Index width, const Number* coarse, Number* x,
                   const Number* q, Real* product) noexcept;

    // rest = b - A x in double precision, for some columns of the block; the array `rest` contains
    // b before. Writes scale rest to r for the functions that are to be taken; adds the squares of
    // rest, x.A x and x.rest.
    struct Residual {
        SymmetricRows const* rows;
        ImaginaryRows imaginary;
        Real* rest;     // [rows x columns x planes]
        Index begin;    // The first column of the block in each plane.
        Index columns;  // The number of columns in each plane.
        Number* r;
        Real scale[FunctionBlock::max_width];
        bool takes[FunctionBlock::max_width];
        Real squares[FunctionBlock::max_width], energy[FunctionBlock::max_width],
            product[FunctionBlock::max_width];
    };
    void (*find_residual)(FunctionBlock const& block, Residual& task) noexcept;
};

// All kernels give the same bits.
template <class Number>
CycleKernels<Number> const& cycle_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
