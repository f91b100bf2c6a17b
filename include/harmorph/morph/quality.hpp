// Mesh quality: signed corner areas, inverted cells, size-skew quality.
#pragma once

#include "harmorph/mesh/cell_shape.hpp"
#include "harmorph/morph/cell_batch.hpp"
#include "harmorph/base/executor.hpp"

namespace harmorph {

// Skew quality in 0..1, 1 for an equilateral triangle and a rectangle, 0 if a corner has no positive area.
// P. M. Knupp, Finite Elem. Anal. Des. 39 (2003) 217: f_skew of quads, f_shape of triangles.
inline Real skew_quality(Index n, CellCorners const& corners) noexcept {
    if (!(corners.smallest() > 0)) return 0;
    const Vec2* const side = corners.side;
    if (n == 3) {
        Real const squares = square(side[0]) + square(side[1]) + square(side[2]);  // = 2 (a.a + b.b - a.b)
        return 2 * 1.7320508075688772 * corners.twice_area[0] / squares;
    }
    Real length[4], sum = 0;
    for (Index k = 0; k < 4; ++k) length[k] = square_root(square(side[k]));
    for (Index k = 0; k < 4; ++k) sum += length[(k + 3) & 3] * length[k] / corners.twice_area[k];
    return 4 / sum;
}

struct Quality {
    Index inverted = 0, first_inverted = none;
    Real min_area = infinity;
    Real min_quality = infinity;
    Index min_quality_cell = none;
    Real quality_sum = 0;
    Index cells = 0;

    Real mean_quality() const noexcept { return quality_sum / static_cast<Real>(cells); }
    // Adds a cell. reference_area: area of the cell in the mesh to compare with, or 0: skew quality alone. sqrt(f_size)
    // f_skew: A. de Boer, M. S. van der Schoot, H. Bijl, Comput. Struct. 85 (2007) 784.
    inline void add(Index cell, Index n, CellCorners const& corners, Real reference_area) noexcept;
    // Adds a cell of which twice the smallest corner area and the quality are known.
    inline void add(Index cell, Real twice_smallest, Real value) noexcept;
    // Adds the cells of some batches.
    void add(CellBatches const& batches, BatchQuality const& triangles, BatchQuality const& quads) noexcept;
    // Of cells that come later.
    void merge(Quality const& later) noexcept;
};

inline void Quality::add(Index cell, Index n, CellCorners const& corners, Real reference_area) noexcept {
    Real value = skew_quality(n, corners);
    if (value > 0 && reference_area != 0) {
        Real const area = corners.cell_area(n), size = absolute(reference_area);
        value *= square_root(smaller(area, size) / larger(area, size));
    }
    add(cell, corners.smallest(), value);
}

inline void Quality::add(Index cell, Real twice_smallest, Real value) noexcept {
    ++cells;
    min_area = smaller(min_area, 0.5 * twice_smallest);
    if (!(twice_smallest > 0) && inverted++ == 0) first_inverted = cell;  // NaN: a coordinate that is not finite
    if (!(value > 0)) value = 0;
    quality_sum += value;
    if (value < min_quality) {
        min_quality = value;
        min_quality_cell = cell;
    }
}

// `reference` not given: the skew quality alone.
Quality measure_quality(OrientedMesh const& cells, Points points, Points reference,
                        Executor const& executor) noexcept;

}  // namespace harmorph
