// Bases that can be used in one safe morph together.
#pragma once

#include "plan/plan.hpp"

namespace harmorph {

// Status::bad_basis unless a step with the other basis moves the wall as one with `basis` does: it
// is solved, of the same mesh, and its curves, parameters and modes are the same.
Status check_other(Basis const& basis, Basis const& other, Fault& fault) noexcept;
// Status::bad_basis unless the derivative of the way fits in: the same functions, derived or not,
// in the same layout.
Status check_derivative(Plan const& plan, Basis const& basis, Basis const& derivative,
                        Fault& fault) noexcept;

}  // namespace harmorph
