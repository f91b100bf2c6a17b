// The passes of conjugate gradients and of a cycle over the rows of a level, as a table of
// functions for each instruction set. tests/multigrid/test_cycle.cpp covers this file.
#pragma once

#include "base/span.hpp"
#include "base/types.hpp"
#include "operators/residual.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// The functions that are solved at a time, and their values.

// The `width` numbers of a row stand side by side in the vectors of a block; in complex blocks the
// first half are real parts, and the other half are imaginary parts.
struct FunctionBlock {
    static constexpr Index max_width = 16;

    // Tells which functions are chosen.
    struct Choice {
        bool column[max_width];
        static Choice every() noexcept {
            Choice out;
            for (bool& one : out.column) one = true;
            return out;
        }
    };

    Index width = 0;
    Index planes = 1;     // 2 if the block is complex.
    Rows values;          // The solutions of all functions.
    Index first = 0;      // The number of the first function of the block.
    Index functions = 0;  // So many functions exist; columns of the block after them are 0.

    Index plane_width() const noexcept { return width / planes; }
    // Returns the values of the block in one plane of a row.
    Real* at(Index row, Index plane) const noexcept {
        return values[row] + plane * values.plane + first;
    }

    // Sets the values of the chosen functions to 0.
    void clear(Index n, Choice const& chosen) const noexcept;
    // rest [rows x planes x columns] receives the right-hand sides of columns from ..
    // from+columns-1 of the block: those that the values on the wall make, and the sources.
    void take_right_hand_sides(Matrix const& matrix, DofValues const& dofs, Index from,
                               Index columns, Real* rest) const noexcept;
    // Finds the largest absolute values of z [n x width] and of the values for each function; NaN
    // for a function with a NaN.
    template <class Number>
    void find_largest(Index n, const Number* z, Real* of_z, Real* of_values) const noexcept;
};

template <class Number>
void FunctionBlock::find_largest(Index n, const Number* z, Real* of_z,
                                 Real* of_values) const noexcept {
    for (Index k = 0; k < plane_width(); ++k) of_z[k] = of_values[k] = 0;
    for (Index i = 0; i < n; ++i, z += width) {
        for (Index plane = 0; plane < planes; ++plane) {
            const Real* const x = at(i, plane);
            for (Index k = 0; k < functions; ++k) {
                Real const in_z = abs(Real{z[plane * plane_width() + k]}), value = abs(x[k]);
                of_z[k] = exceeds(in_z, of_z[k]) ? in_z : of_z[k];
                of_values[k] = exceeds(value, of_values[k]) ? value : of_values[k];
            }
        }
    }
}

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
    // The last level has none of the arrays below.
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
    // The parts of symmetric Gauss-Seidel with a coarse correction in between, for a
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
