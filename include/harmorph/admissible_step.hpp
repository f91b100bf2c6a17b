// How far the mesh can go along a displacement before a cell inverts, exactly.
#pragma once

#include "harmorph/cell_shape.hpp"
#include "harmorph/executor.hpp"

namespace harmorph {

struct AdmissibleStep {
    Real step = infinity;
    Index cell = none, corner = none;  // of `cell`, the corner whose area becomes 0 first

    // Of `number`, whose points move from `now` by `change`.
    void add(Index number, CellShape const& now, CellShape const& change, CellCorners const& corners) noexcept;
    void merge(AdmissibleStep const& later) noexcept {
        if (later.step < step) *this = later;
    }
};

// Smallest s >= 0 at which a corner of points + s displacement has no positive area: the smallest non-negative root of the
// corners' quadratics.
AdmissibleStep admissible_step(Mesh const& mesh, Points points, Points displacement, Span<const std::uint8_t> reversed,
                               Executor const& executor) noexcept;

// The mesh point of a limiting corner.
Index limiting_point(Mesh const& mesh, AdmissibleStep const& limit, Span<const std::uint8_t> reversed) noexcept;

}  // namespace harmorph
