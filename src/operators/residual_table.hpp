// The residuals of all rows with one instruction set as a function table.
#pragma once

#include "harmorph/operators/residual.hpp"

namespace harmorph {

// Of numbers in double or in single precision.
template <class To>
struct ResidualKernels {
    // Balances of all rows, into `value` if there is one: columns first .. first+n-1.
    void (*find_balances)(Residual const& work, Matrix const& matrix, DofValues const& dofs, Index first, Index n,
                          To* value, Residual::Norms& norms) noexcept;
};

template <class To>
ResidualKernels<To> const& residual_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
