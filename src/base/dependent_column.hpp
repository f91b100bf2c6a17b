// Are the columns of a matrix independent?
#pragma once

#include "base/span.hpp"

namespace harmorph {

// The first column that is zero to rounding, or a combination of those before; none: they are
// independent. The matrix, [rows * n * numbers] as in the C header, is orthogonalised in place
// (modified Gram-Schmidt, twice).
struct DependentColumn {
    Index column = none;
    bool is_zero = false;
};
DependentColumn find_dependent_column(Span<Real> matrix, Index n, Index numbers) noexcept;

}  // namespace harmorph
