// The targets of the cells of a deformed mesh, and the quality that no cell should fall below.
#pragma once

#include "base/arena.hpp"
#include "boundary/distance.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"
#include "safe/corner_triangle.hpp"

namespace harmorph {

// The target of a cell is the cell of the reference mesh, with two exceptions:
//   Thin cells along walls are stretched along the wall by 1 + thinness fade (stretch - 1). They
//   must become longer where the wall does; so their targets keep the heights, instead of trading
//   them for the shape.
//       stretch    length of the nearest wall face, now divided by before;
//       thinness   max(0, 1 - a), a the extent of the reference cell normal to that face divided by
//       that along it; fade       max(0, 1 - d / reach), d the distance from the wall, reach a
//       quarter of the extent of all walls.
//   Of quadrilaterals that are not thin only the area and the angles matter, as in their quality,
//   not the ratio of their sides.
struct Targets {
    struct Cell {
        Vec2 along;      // the unit tangent of the wall before the movement
        Real more = 0;   // the factor of the stretch along the wall, minus 1
        Real area = 0;   // the area of the reference cell
        Real least = 0;  // the size-skew quality that the cell should have
        Real own = 1;    // the skew quality of the reference cell
        bool is_quad = false;
        // If true, the cell is one of several pieces of a polygon, or a guard, and its reference is
        // the ideal shape.
        bool is_part = false;
        bool any_ratio = false;  // the ratio of sides may have any value
    };
    // No cell should have less than the smallest quality of the reference mesh, or than this part
    // of its own quality there.
    static constexpr Real part_of_own = 0.5;

    Points reference;
    Span<Cell> cell;  // [cells and guards]

    void lay_out(Arena& arena, Index n_cells) noexcept { arena.take(cell, n_cells); }
    // The faces `walls` were built at `before`, and there may be none. All cells of `before` are
    // valid.
    void find(OrientedMesh const& cells, FaceDistance const& walls, Points before, Points now,
              Executor const& executor) noexcept;

    // Returns the target of the corner of a cell with these three points, the present sides of
    // which are those of `now`.
    Triangle of(Index number, CornerPoints const& points, Triangle const& now) const noexcept;
    // Returns the weight of a corner. A quadrilateral has four corners, and a polygon has more than
    // two parts for each corner.
    Real share(Index number) const noexcept {
        return cell[number].is_quad || cell[number].is_part ? 0.25 : 1;
    }
    // Returns the corner of best quality with the area of the reference corner: that of an
    // equilateral triangle, or of a rectangle. A corner that is this one, turned, has the size-skew
    // quality 1.
    Triangle ideal(Index number, CornerPoints const& points, Triangle const& now) const noexcept;
    // Return the sizes of the maps from these targets to `now`, by fewer operations.
    MapSizes sizes(Index number, CornerPoints const& points, Triangle const& now) const noexcept;
    MapSizes ideal_sizes(Index number, CornerPoints const& points,
                         Triangle const& now) const noexcept;
    // Returns the size-skew quality as measure_quality() defines it; for parts of polygons it is
    // relative to the reference and at most 1.
    Real quality(Index number, CellShape const& now) const noexcept;

private:
    void find_stretch(Cell& target, CellShape const& shape, FaceDistance const& walls, Points now,
                      Index& group) const noexcept;
};

// The height of an equilateral triangle with sides of length 1.
inline constexpr Real equilateral_height = 0.8660254037844386;

// Returns the target with sides in the ratio of those of `now`: the area stays, and |J|^2 of the
// map from this target to `now` is the smallest for all ratios. Therefore the derivatives of |J|^2
// need no term for the dependence of the target on `now`.
inline Triangle with_ratio_of(Triangle const& now, Vec2 side, Vec2 next) noexcept {
    Real const ratio = square(now.at[1] - now.at[0]) / square(now.at[2] - now.at[1]) *
                       (square(next) / square(side));
    Real const root = sqrt(sqrt(ratio));
    return {{-root * side, {0, 0}, 1 / root * next}};
}

inline Triangle Targets::of(Index number, CornerPoints const& points,
                            Triangle const& now) const noexcept {
    Triangle triangle = triangle_of(points, reference);
    Cell const& target = cell[number];
    if (target.any_ratio)
        return with_ratio_of(now, triangle.at[1] - triangle.at[0], triangle.at[2] - triangle.at[1]);
    if (target.more == 0) return triangle;
    for (Vec2& at : triangle.at) at = at + target.more * dot(target.along, at) * target.along;
    return triangle;
}

inline Triangle Targets::ideal(Index number, CornerPoints const& points,
                               Triangle const& now) const noexcept {
    Triangle const before = triangle_of(points, reference);
    if (cell[number].is_part) return before;
    Real const twice_area = before.twice_area();
    if (cell[number].is_quad) {
        Real const side = sqrt(twice_area);
        return with_ratio_of(now, {side, 0}, {0, side});
    }
    Real const side = sqrt(twice_area / equilateral_height);
    return {{{0, 0}, {side, 0}, {0.5 * side, equilateral_height * side}}};
}

// With the sides a and b of the target, c and d of `now`, and the area A of the target's
// parallelogram, p + q is (|a|^2 |d|^2 + |b|^2 |c|^2 - 2 (a b) (c d)) / 2 A^2. The ratio of
// with_ratio_of() makes the first two terms equal.
inline MapSizes Targets::sizes(Index number, CornerPoints const& points,
                               Triangle const& now) const noexcept {
    if (!cell[number].any_ratio) return CornerMap(of(number, points, now)).sizes(now);
    Triangle const triangle = triangle_of(points, reference);
    Vec2 const a = triangle.at[1] - triangle.at[0], b = triangle.at[2] - triangle.at[1],
               c = now.at[1] - now.at[0], d = now.at[2] - now.at[1];
    Real const twice_area = cross(a, b), per_area = 1 / twice_area;
    Real const lengths = sqrt((per_area * square(a)) * (per_area * square(b))) *
                         sqrt((per_area * square(c)) * (per_area * square(d)));
    return {per_area * cross(c, d), lengths - (per_area * dot(a, b)) * (per_area * dot(c, d)),
            twice_area};
}

// Here a and b are perpendicular, or sides of an equilateral triangle.
inline MapSizes Targets::ideal_sizes(Index number, CornerPoints const& points,
                                     Triangle const& now) const noexcept {
    Triangle const triangle = triangle_of(points, reference);
    if (cell[number].is_part) return CornerMap(triangle).sizes(now);
    Vec2 const c = now.at[1] - now.at[0], d = now.at[2] - now.at[1];
    Real const twice_area = triangle.twice_area(), per_area = 1 / twice_area;
    Real const s = cell[number].is_quad ? sqrt((per_area * square(c)) * (per_area * square(d)))
                                        : 0.25 / equilateral_height * per_area *
                                              (square(c) + square(d) + square(c + d));
    return {per_area * cross(c, d), s, twice_area};
}

}  // namespace harmorph
