// The residuals of all rows with one instruction set as a function table.
// tests/operators/test_residual.cpp covers this file.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

// Rows whose balances are computed one after the other.
struct BalancedRows {
    PositionRange rows;
    Index limit;  // Rows below this one belong to the task.
    // The list of the rows that are left over for rows behind the limit begins here; see
    // Residual::next.
    Index left_over = none;
};

// Kernels for numbers in double or in single precision.
template <class To>
struct ResidualKernels {
    // Computes the balances of these rows for columns first .. first+n-1, and stores them in
    // `value` (of all rows) unless it is null. Adds to norms.
    void (*find_balances)(Residual const& work, Matrix const& matrix, DofValues const& dofs,
                          Index first, Index n, BalancedRows& task, To* value,
                          Residual::Norms& norms) noexcept;
};

template <class To>
ResidualKernels<To> const& residual_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
