// Decides whether the columns of a matrix are linearly independent.
// tests/bspline/test_variables.cpp and tests/basis/test_combination.cpp cover this file.
#pragma once

#include "base/span.hpp"

namespace harmorph {

// Finds the first column that is zero to rounding, or a linear combination of the columns before
// it. The column `none` says that all columns are independent. The matrix [rows * n * numbers],
// laid out as in the C header, is orthogonalised in place by two passes of modified Gram-Schmidt.
struct DependentColumn {
    Index column = none;
    bool is_zero = false;
};
DependentColumn find_dependent_column(Span<Real> matrix, Index n, Index numbers) noexcept;

}  // namespace harmorph
