// Residuals where x and y are coupled: two dofs a point, of which a slipping point has one.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

// value [matrix.n x width] out: b - A F of columns first .. first+n-1 of F, n <= width. Returns
// their norms.
Residual::Norms find_turned_balances(Matrix const& matrix, DofValues const& dofs, Index first,
                                     Index n, Index width, Span<Real> value) noexcept;

}  // namespace harmorph
