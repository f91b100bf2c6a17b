// The residuals of all rows with one instruction set as a function table.
// tests/operators/test_residual.cpp covers this file.
#pragma once

#include "operators/residual.hpp"

namespace harmorph {

// Rows whose balances are computed one after the other.
struct BalancedRows {
    PositionRange rows;
    Index limit;  // Rows below this one belong to the task.
    // The list of the rows that are left over for rows after the limit begins here; see
    // Residual::next.
    Index left_over = none;
};

struct ResidualKernels {
    // Computes the balances of these rows for columns first .. first+n-1, and adds their squares to
    // norms. If `stores` is true, the balances are stored in the array of `work` that exists.
    void (*find_balances)(Residual const& work, Matrix const& matrix, DofValues const& dofs,
                          Index first, Index n, BalancedRows& task, bool stores,
                          Residual::Norms& norms) noexcept;
};

ResidualKernels const& residual_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
