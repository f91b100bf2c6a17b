// Neumann values: given normal derivatives of the functions on faces of free boundaries.
// tests/plan/test_fluxes.cpp covers this file.
#pragma once

#include "boundary/conditions.hpp"

namespace harmorph {

// Views of the caller's arrays; all counts are consistent.
struct Fluxes {
    Index index_base = 0;     // the number of the first mesh point
    Span<const Index> point;  // [2 * count()] the two points of each face
    Span<const Real> value;   // [count() * n_control] the derivatives of one face side by side
    Index n_control = 0;      // the functions that have fluxes, which precede all others

    Index count() const noexcept { return point.count() / 2; }
    Index end(Index flux, Index number) const noexcept {
        return from_zero(point[2 * flux + number], index_base);
    }
    const Real* of(Index flux) const noexcept { return value.data() + Offset{flux} * n_control; }
};

// Refuses fluxes of faces that are not free or are named twice, and values out of range. The
// working space of order() of the boundary is used.
Status check_fluxes(Fluxes const& fluxes, Topology const& topology, Boundary const& boundary,
                    Span<const Condition> conditions, Fault& fault) noexcept;

// Returns the fingerprint `others` of the conditions, combined with the fluxes; if there are no
// fluxes, returns `others`.
std::uint64_t fingerprint_with(std::uint64_t others, Fluxes const& fluxes) noexcept;

}  // namespace harmorph
