// Mesh quality: signed corner areas, inverted cells, size-skew quality.
#pragma once

#include "base/elementary.hpp"
#include "base/executor.hpp"
#include "mesh/cell_shape.hpp"
#include "morph/cell_batch.hpp"

namespace harmorph {

// The formula of the skew quality, for one cell and for several at a time.

// Both functions return numerator and denominator of the skew quality. For a triangle they take
// twice the area and the sum of the squares of the sides. For a quad they take twice the areas of
// the corners, the roots of the squared products of the sides 0 and 1, 1 and 2, 2 and 3, and the
// square of the second root. Number is a Real, or a vector of them for several cells, so results
// are references. The quad's quality is 4 / (l0 l1 / A1 + l1 l2 / A2 + l2 l3 / A3 + l3 l0 / A0)
// over the common denominator, with three roots for the four products of lengths.
template <class Number>
__attribute__((always_inline)) inline void skew_of_triangle(Number const& area,
                                                            Number const& squares,
                                                            Number& numerator,
                                                            Number& denominator) noexcept {
    numerator = 2 * 1.7320508075688772 * area;
    denominator = squares;
}
template <class Number>
__attribute__((always_inline)) inline void skew_of_quad(Number const (&area)[4],
                                                        Number const (&root)[3],
                                                        Number const& opposite, Number& numerator,
                                                        Number& denominator) noexcept {
    Number const first = area[1] * area[2], last = area[3] * area[0];
    numerator = 4 * root[1] * (first * last);
    denominator = (root[0] * root[1] * area[2] + opposite * area[1]) * last +
                  root[2] * (root[1] * area[0] + root[0] * area[3]) * first;
}

// A quality as a fraction that is divided last, together with another one. Numerator and
// denominator neither overflow nor underflow if they are multiplied by an area for which products
// of six are representable.
struct Fraction {
    Real numerator, denominator;
};

// Returns the skew quality in 0..1, which is 1 for an equilateral triangle and a rectangle, and 0
// if a corner has no positive area. P. M. Knupp, Finite Elem. Anal. Des. 39 (2003) 217: f_skew of
// quads, f_shape of triangles.
inline Fraction skew_fraction(Index n, CellCorners const& corners) noexcept {
    if (!(corners.smallest() > 0)) return {0, 1};
    const Real* const area = corners.twice_area;
    Vec2 const(&side)[4] = corners.side;
    Real const square_of[4] = {square(side[0]), square(side[1]), square(side[2]),
                               n == 3 ? 0 : square(side[3])};
    // With two sides a and b of a triangle, the sum is 2 (a.a + b.b - a.b).
    Real const squares = n == 3 ? square_of[0] + square_of[1] + square_of[2]
                                : (square_of[0] + square_of[2]) + (square_of[1] + square_of[3]);
    bool const in_range = corners.smallest() > min_factor && squares < max_factor;
    Fraction skew;
    if (n == 3) {
        skew_of_triangle(area[0], squares, skew.numerator, skew.denominator);
        return in_range ? skew : Fraction{skew.numerator / skew.denominator, 1};
    }
    if (in_range) {
        Real const opposite = square_of[1] * square_of[2];
        Real const root[3] = {sqrt(square_of[0] * square_of[1]), sqrt(opposite),
                              sqrt(square_of[2] * square_of[3])};
        Real const corner[4] = {area[0], area[1], area[2], area[3]};
        skew_of_quad(corner, root, opposite, skew.numerator, skew.denominator);
        return skew;
    }
    Real length[4], sum = 0;
    for (Index k = 0; k < 4; ++k) length[k] = sqrt(square_of[k]);
    for (Index k = 0; k < 4; ++k) sum += length[(k + 3) & 3] * length[k] / area[k];
    return {4 / sum, 1};
}

// The measures of one of the caller's cells; a polygon is measured with all its pieces and guards.
struct CellMeasure {
    Real twice_smallest;  // Twice the smallest corner area.
    Fraction skew;        // The skew quality.
    Real area;

    CellMeasure(Index n, CellCorners const& corners) noexcept
        : twice_smallest(corners.smallest()),
          skew(skew_fraction(n, corners)),
          area(corners.cell_area(n)) {}
    // Measures one of the caller's cells. shape_of(i) returns the CellShape of a cell, which may be
    // a piece, or of a guard, counter-clockwise.
    template <class ShapeOf>
    CellMeasure(Mesh const& mesh, Index number, ShapeOf const& shape_of) noexcept;

    // Returns sqrt(f_size) f_skew: A. de Boer, M. S. van der Schoot, H. Bijl, Comput. Struct. 85
    // (2007) 784. reference_area is the area of the cell in the mesh to compare with, or 0 for the
    // skew quality alone. The result is 0 if the cell is inverted.
    Real quality(Real reference_area) const noexcept {
        if (!(skew.numerator > 0)) return 0;
        Real const size = abs(reference_area), smaller_area = min(area, size),
                   larger_area = max(area, size);
        if (size == 0) return skew.numerator / skew.denominator;
        bool const in_range = smaller_area > min_factor && larger_area < max_factor && size == size;
        if (in_range) return skew.numerator * sqrt(area * size) / (skew.denominator * larger_area);
        return skew.numerator / skew.denominator * sqrt(smaller_area / larger_area);
    }
};

struct Quality {
    Index inverted = 0, first_inverted = none;
    Real min_area = infinity;
    Real min_quality = infinity;
    Index min_quality_cell = none;
    Real quality_sum = 0;
    Index cells = 0;

    Real mean_quality() const noexcept { return quality_sum / static_cast<Real>(cells); }
    // The next two functions write the quality of each cell that they add to `all`, unless null.
    // Adds a cell, compared with reference_area; see CellMeasure::quality().
    inline void add(Index cell, CellMeasure const& measure, Real reference_area,
                    Real* all = nullptr) noexcept;
    // Adds the cells of some batches that kernels have measured.
    void add(OrientedMesh const& mesh, CellPlaces const& places, CellBatches const& batches,
             ListQuality const& triangles, ListQuality const& quads, Real* all = nullptr) noexcept;
    // Merges the result of cells that come later.
    void merge(Quality const& later) noexcept;

private:
    // Notes a cell that may have the smallest area or quality, or may be inverted.
    inline void note(Index cell, Real twice_smallest, Real value) noexcept;
};

inline void Quality::add(Index cell, CellMeasure const& measure, Real reference_area,
                         Real* all) noexcept {
    Real const value = measure.quality(reference_area), counted = value > 0 ? value : 0;
    note(cell, measure.twice_smallest, value);
    quality_sum += counted;
    if (all != nullptr) all[cell] = counted;
    ++cells;
}

inline void Quality::note(Index cell, Real twice_smallest, Real value) noexcept {
    // The area is NaN if a coordinate is not finite.
    bool const is_number = twice_smallest == twice_smallest;
    min_area = min(min_area, is_number ? 0.5 * twice_smallest : -infinity);
    if (!(twice_smallest > 0) && inverted++ == 0) first_inverted = cell;
    if (!(value > 0)) value = 0;
    if (value < min_quality) {
        min_quality = value;
        min_quality_cell = cell;
    }
}

// The quality of m convex corners with interior angles t is m / (sin(2 pi / m) sum 1 / sin t), as
// the C header states; for m = 4 this is f_skew.
template <class ShapeOf>
CellMeasure::CellMeasure(Mesh const& mesh, Index number, ShapeOf const& shape_of) noexcept
    : twice_smallest(infinity), skew{0, 1}, area(0) {
    IndexRange const pieces = mesh.pieces_of(number);
    if (pieces.count() == 1) {
        CellShape const shape = shape_of(pieces.first);
        *this = CellMeasure(shape.n, CellCorners(shape));
        return;
    }
    // A NaN is kept.
    auto const lower_to = [this](Real twice_area) {
        bool const is_number = twice_smallest == twice_smallest;
        if (is_number && !(twice_area >= twice_smallest)) twice_smallest = twice_area;
    };
    for (Index const piece : pieces) {
        // The piece is a triangle.
        Real const twice_area = CellCorners(shape_of(piece)).smallest();
        lower_to(twice_area);
        area += 0.5 * twice_area;
    }
    Real sum = 0;
    Index m = 0;
    for (Index const guard : mesh.guards_of(number)) {
        CellCorners const corner(shape_of(guard));
        bool const is_convex = mesh.guard_kind[guard - mesh.n_cells] == CornerKind::convex;
        if (is_convex || !(corner.smallest() > 0)) lower_to(corner.smallest());
        if (!is_convex || !(twice_smallest > 0)) continue;
        sum += length(corner.side[0]) * length(corner.side[1]) / corner.twice_area[0];
        ++m;
    }
    if (!(twice_smallest > 0)) return;
    skew.numerator = m < 3 ? 1 : min(1.0, m / (sum * sine_of_pi(2.0 / m)));
}

// Measures one of the caller's cells in any layout.
CellMeasure measure_cell(OrientedMesh const& cells, Index number, Points points) noexcept;

// Without `reference` the quality is the skew quality. `all` [given cells], unless null, receives
// the quality of each cell, here and in morph/admissible_step.hpp.
Quality measure_quality(OrientedMesh const& cells, Points points, Points reference,
                        Executor const& executor, Real* all = nullptr) noexcept;

// Counts the cells and guards of which a corner has no positive area, either exactly or in the
// floating-point arithmetic of the quality.
Index count_inverted(OrientedMesh const& cells, Points points, Executor const& executor) noexcept;

}  // namespace harmorph
