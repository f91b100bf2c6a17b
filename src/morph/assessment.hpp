// Assesses a displacement in one pass over the cells: the admissible step, and the quality of the
// displaced mesh.
#pragma once

#include "morph/admissible_step.hpp"
#include "morph/quality.hpp"

namespace harmorph {

struct Assessment {
    AdmissibleStep limit;
    Quality quality;  // The quality at points + displacement, relative to the mesh at points.

    void merge(Assessment const& later) noexcept {
        limit.merge(later.limit);
        quality.merge(later.quality);
    }
};

// If the step is not wanted, `limit` is not meaningful, and less time is needed.
Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor, bool wants_step = true) noexcept;

// Returns the quality at points + displacement, relative to the mesh at the coordinates
// `reference`.
Quality displaced_quality(OrientedMesh const& cells, Points points, Points displacement,
                          Points reference, Executor const& executor) noexcept;

}  // namespace harmorph
