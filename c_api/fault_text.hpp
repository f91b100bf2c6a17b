// Translates a fault of the core into the caller's hm_error: the numbers of items count from the
// caller's index bases, and the text is one sentence.
#pragma once

#include "harmorph.h"
#include "base/types.hpp"

namespace harmorph {

// The index bases of the caller. `mesh` holds for all items except curves, control points and
// knots, for which `curves` holds. Where only one of the two is known, it holds for all items.
struct Bases {
    Index mesh = none;
    Index curves = none;
};

// Fills *err, which may be null, and returns the status. A fault with Status::ok clears the error.
hm_status tell(hm_error* err, Fault const& fault, Bases bases = {}) noexcept;

}  // namespace harmorph
