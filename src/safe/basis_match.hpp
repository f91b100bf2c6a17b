// Checks that bases can be used together in one safe morph.
#pragma once

#include "plan/plan.hpp"

namespace harmorph {

// Returns Status::bad_basis unless a step with the other basis moves the wall as a step with
// `basis` does: the other basis must be solved on the same mesh and have the same curves,
// parameters and modes.
Status check_other(Basis const& basis, Basis const& other, Fault& fault) noexcept;
// Returns Status::bad_basis unless the derivative of the safe morph fits into the block of the
// basis: both must have the same functions, derived or not, in the same layout.
Status check_derivative(Plan const& plan, Basis const& basis, Basis const& derivative,
                        Fault& fault) noexcept;

}  // namespace harmorph
