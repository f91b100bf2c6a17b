// A view of rows of numbers in an array of the caller or the core, with one row for each position:
// for example the values of all functions at the unknowns' points.
#pragma once

#include "base/types.hpp"

namespace harmorph {

template <class Number>
struct RowsOf {
    Number* data = nullptr;
    // [n] The row of each position; null means that row and position have the same number.
    const Index* row_of = nullptr;
    Offset row_length = 0;  // the distance from one row to the next, in numbers
    Index width = 0;        // the number of right-hand sides
    // The distance from the real parts of a row to the imaginary parts, for complex values.
    Offset plane = 0;

    Number* operator[](Index position) const noexcept {
        return data + (row_of != nullptr ? row_of[position] : position) * row_length;
    }
};
using Rows = RowsOf<Real>;

}  // namespace harmorph
