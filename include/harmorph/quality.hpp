// How good the cells are: signed corner areas, inverted cells, size-skew quality.
#pragma once

#include "harmorph/cell_shape.hpp"
#include "harmorph/executor.hpp"

namespace harmorph {

// Skew quality in 0..1, 1 for an equilateral triangle and a rectangle, 0 if a corner has no positive area.
// P. M. Knupp, Finite Elem. Anal. Des. 39 (2003) 217: f_skew of quads, f_shape of triangles.
Real skew_quality(Index n, CellCorners const& corners) noexcept;

struct Quality {
    Index inverted = 0, first_inverted = none;
    Real min_area = infinity;
    Real min_quality = infinity;
    Index min_quality_cell = none;
    Real quality_sum = 0;
    Index cells = 0;

    Real mean_quality() const noexcept { return quality_sum / static_cast<Real>(cells); }
    // reference_area: of the cell on the mesh it is compared with, or 0. sqrt(f_size) f_skew: A. de Boer, M. S. van der
    // Schoot, H. Bijl, Comput. Struct. 85 (2007) 784.
    void add(Index cell, Index n, CellCorners const& corners, Real reference_area) noexcept;
    // Of cells that come later.
    void merge(Quality const& later) noexcept;
};

// `reference` not given: the skew quality alone.
Quality measure_quality(Mesh const& mesh, Points points, Points reference, Span<const std::uint8_t> reversed,
                        Executor const& executor) noexcept;

}  // namespace harmorph
