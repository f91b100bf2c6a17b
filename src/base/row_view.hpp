// Rows of numbers somewhere, one for each position: the functions' values at the unknowns' points.
#pragma once

#include "base/types.hpp"

namespace harmorph {

template <class Number>
struct RowsOf {
    Number* data = nullptr;
    const Index* row_of =
        nullptr;  // [n] row of each position, or null: row and position have the same number
    Offset row_length = 0;  // numbers from one row to the next
    Index width = 0;        // right-hand sides
    Offset plane = 0;       // complex: from the real parts of a row to the imaginary parts

    Number* operator[](Index position) const noexcept {
        return data + (row_of != nullptr ? row_of[position] : position) * row_length;
    }
};
using Rows = RowsOf<Real>;

}  // namespace harmorph
