// From the core's fault to the caller's hm_error: numbers in the caller's numbering, one sentence.
#pragma once

#include "harmorph.h"
#include "base/types.hpp"

namespace harmorph {

// What the caller counts from: `mesh` holds for everything but curves, control points and knots,
// for which `curves` does. Where only one of them is known, it holds for both.
struct Bases {
    Index mesh = none;
    Index curves = none;
};

// Fills *err (may be null) and returns the status. A fault without status clears the error.
hm_status tell(hm_error* err, Fault const& fault, Bases bases = {}) noexcept;

}  // namespace harmorph
