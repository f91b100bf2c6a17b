// How far the mesh can go along a displacement before a cell inverts, exactly.
#pragma once

#include "harmorph/mesh.hpp"

namespace harmorph {

struct AdmissibleStep {
    Real step = infinity;
    Index cell = none, point = none;  // the corner whose area becomes 0 first
};

// Smallest s >= 0 at which a corner of points + s displacement has no positive area: the smallest non-negative root of the
// corners' quadratics.
AdmissibleStep admissible_step(Mesh const& mesh, Points points, Points displacement,
                               Span<const std::uint8_t> reversed) noexcept;

}  // namespace harmorph
