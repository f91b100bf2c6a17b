// How good the cells are: signed corner areas, inverted cells, size-skew quality.
#pragma once

#include "harmorph/mesh.hpp"

namespace harmorph {

struct Quality {
    Index inverted = 0, first_inverted = none;
    Real min_area = infinity;
    Real min_quality = infinity, mean_quality = 0;
    Index min_quality_cell = none;
};

// Skew quality in 0..1, 1 for an equilateral triangle and a rectangle, 0 if a corner has no positive area.
// P. M. Knupp, Finite Elem. Anal. Des. 39 (2003) 217: f_skew of quads, f_shape of triangles.
Real skew_quality(Cell const& cell, Points points, bool reversed) noexcept;

// `reference` not given: f_size = 1. sqrt(f_size) f_skew: A. de Boer, M. S. van der Schoot, H. Bijl, Comput. Struct. 85
// (2007) 784.
Quality measure_quality(Mesh const& mesh, Points points, Points reference, Span<const std::uint8_t> reversed) noexcept;

}  // namespace harmorph
