// Mesh quality: signed corner areas, inverted cells, size-skew quality.
#pragma once

#include "harmorph/base/elementary.hpp"
#include "harmorph/mesh/guard_shape.hpp"
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

// One cell of the caller's: of a polygon, that of all its pieces and guards.
struct CellMeasure {
    Real twice_smallest;  // corner area
    Real skew;            // quality
    Real area;

    CellMeasure(Index n, CellCorners const& corners) noexcept
        : twice_smallest(corners.smallest()), skew(skew_quality(n, corners)), area(corners.cell_area(n)) {}
    // shape_of(i): the CellShape of a piece or a guard, counter-clockwise.
    template <class ShapeOf>
    CellMeasure(Mesh const& mesh, Index number, ShapeOf const& shape_of) noexcept;
};

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
    inline void add(Index cell, CellMeasure const& measure, Real reference_area) noexcept;
    // Adds a cell of which twice the smallest corner area and the quality are known.
    inline void add(Index cell, Real twice_smallest, Real value) noexcept;
    // Adds the cells of some batches.
    void add(CellBatches const& batches, BatchQuality const& triangles, BatchQuality const& quads) noexcept;
    // Of cells that come later.
    void merge(Quality const& later) noexcept;
};

inline void Quality::add(Index cell, CellMeasure const& measure, Real reference_area) noexcept {
    Real value = measure.skew;
    if (value > 0 && reference_area != 0) {
        Real const area = measure.area, size = absolute(reference_area);
        value *= square_root(smaller(area, size) / larger(area, size));
    }
    add(cell, measure.twice_smallest, value);
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

// Of m convex corners with interior angles t: m / (sin(2 pi / m) sum 1 / sin t), as the header has it; for m = 4, f_skew.
template <class ShapeOf>
CellMeasure::CellMeasure(Mesh const& mesh, Index number, ShapeOf const& shape_of) noexcept
    : twice_smallest(infinity), skew(0), area(0) {
    Index const begin = mesh.piece_start[number], end = mesh.piece_start[number + 1];
    if (end - begin == 1) {
        CellShape const shape = shape_of(begin);
        *this = CellMeasure(shape.n, CellCorners(shape));
        return;
    }
    auto const least = [this](Real twice_area) {  // NaN stays
        if (!(twice_area >= twice_smallest)) twice_smallest = twice_area;
    };
    for (Index piece = begin; piece < end; ++piece) {
        Real const twice_area = CellCorners(shape_of(piece)).twice_area[0];
        least(twice_area);
        area += 0.5 * twice_area;
    }
    Real sum = 0;
    Index m = 0;
    for (Index guard = mesh.guard_start[number]; guard < mesh.guard_start[number + 1]; ++guard) {
        CellCorners const corner(shape_of(guard));
        bool const is_convex = mesh.guard_kind[guard - mesh.n_cells] == CornerKind::convex;
        if (is_convex || !(corner.twice_area[0] > 0)) least(corner.twice_area[0]);
        if (!is_convex || !(twice_smallest > 0)) continue;
        sum += length(corner.side[0]) * length(corner.side[1]) / corner.twice_area[0];
        ++m;
    }
    if (!(twice_smallest > 0)) return;
    skew = m < 3 ? 1 : smaller(1.0, m / (sum * sine_of_pi(2.0 / m)));
}

// Of the caller's cell, whatever its layout.
CellMeasure measure_cell(OrientedMesh const& cells, Index number, Points points) noexcept;

// `reference` not given: the skew quality alone.
Quality measure_quality(OrientedMesh const& cells, Points points, Points reference,
                        Executor const& executor) noexcept;

}  // namespace harmorph
