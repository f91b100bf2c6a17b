// The functions that are solved at a time, and their values. tests/multigrid/test_multigrid.cpp
// covers this file.
#pragma once

#include "base/row_view.hpp"
#include "operators/residual.hpp"

namespace harmorph {

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
    // Returns the values of the block in a row: those of one plane.
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

}  // namespace harmorph
