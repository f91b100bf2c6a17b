// From the handle of a basis to its views, and what calls ask of it.
#pragma once

#include "harmorph/basis/basis.hpp"
#include "views.hpp"

namespace harmorph {

inline Status open_basis(const hm_basis* basis, Basis& out, Fault& fault) noexcept {
    if (basis == nullptr) return fault.refuse(Status::bad_argument, "basis is NULL");
    out = Basis::view(static_cast<const void*>(basis));
    return Status::ok;
}

inline Status open_solved(const hm_basis* basis, Basis& out, Fault& fault) noexcept {
    HARMORPH_TRY(open_basis(basis, out, fault));
    if (out.header->solved == 1) return Status::ok;
    return fault.refuse(Status::bad_basis, "the basis has not been solved");
}

// Solved, and with all functions.
inline Status open_complete(const hm_basis* basis, Basis& out, Fault& fault) noexcept {
    HARMORPH_TRY(open_solved(basis, out, fault));
    BasisCounts const& counts = out.header->counts;
    if (counts.complete()) return Status::ok;
    return fault.refuse(Status::bad_basis, "the basis is a share: it has only # of the @ functions", Counts::from_zero,
                        counts.stored, counts.functions());
}

}  // namespace harmorph
