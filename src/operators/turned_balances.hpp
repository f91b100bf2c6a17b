// Residuals if x and y are coupled: a point has two dofs, or one if it slips.
// tests/operators/test_residual.cpp covers this file.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

// Stores b - A F for columns first .. first+n-1 of F, n <= width, in value [matrix.n x width].
// Returns the norms.
Residual::Norms find_turned_balances(Matrix const& matrix, DofValues const& dofs, Index first,
                                     Index n, Index width, Span<Real> value) noexcept;

}  // namespace harmorph
