// The residuals of all rows with one instruction set as a function table.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

// Rows whose balances are found one after the other.
struct BalancedRows {
    PositionRange rows;
    Index limit;  // the task goes on with rows below this one, ...
    Index left_over =
        none;  // ... the list of those that wait for others begins here, see Residual::next
};

// Of numbers in double or in single precision.
template <class To>
struct ResidualKernels {
    // Balances of these rows, into `value` (of all rows) if there is one: columns first ..
    // first+n-1. Adds to norms.
    void (*find_balances)(Residual const& work, Matrix const& matrix, DofValues const& dofs,
                          Index first, Index n, BalancedRows& of, To* value,
                          Residual::Norms& norms) noexcept;
};

template <class To>
ResidualKernels<To> const& residual_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
