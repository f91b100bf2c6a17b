// What the cells of a deformed mesh should be, and the quality that no cell should fall below.
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
        Vec2 along;      // unit tangent of the wall, before
        Real more = 0;   // factor of the stretch along it, less 1
        Real area = 0;   // of the reference cell
        Real least = 0;  // size-skew quality that the cell should have
        Real own = 1;    // skew quality of the reference cell
        bool is_quad = false;
        bool is_part =
            false;  // one of several pieces of a polygon, or a guard: the reference is the ideal
        bool any_ratio = false;  // of sides
    };
    // No cell should have less than the smallest quality of the reference mesh, or than this part
    // of its own there.
    static constexpr Real part_of_own = 0.5;

    Points reference;
    Span<Cell> cell;  // [cells and guards]

    void lay_out(Arena& arena, Index n_cells) noexcept { arena.take(cell, n_cells); }
    // walls: built at `before`; may be none. Cells of `before` are valid.
    void find(OrientedMesh const& cells, FaceDistance const& walls, Points before, Points now,
              Executor const& executor) noexcept;

    // Of the corner of a cell with these three points, whose sides are now those of `now`.
    Triangle of(Index number, CornerPoints const& points, Triangle const& now) const noexcept;
    // How much a corner counts: a quadrilateral has four, a polygon more than two parts for each
    // corner.
    Real share(Index number) const noexcept {
        return cell[number].is_quad || cell[number].is_part ? 0.25 : 1;
    }
    // The corner of best quality with the area of the reference's: of an equilateral triangle, or
    // of a rectangle. To be it, turned, is to have the size-skew quality 1.
    Triangle ideal(Index number, CornerPoints const& points, Triangle const& now) const noexcept;
    // Size-skew quality, as measure_quality has it; of parts of polygons relative to that of the
    // reference, at most 1.
    Real quality(Index number, CellShape const& now) const noexcept;

private:
    void find_stretch(Cell& target, CellShape const& shape, FaceDistance const& walls, Points now,
                      Index& group) const noexcept;
};

// Sides in the ratio of `now`: the area stays, and |J|^2 of the map from here to `now` is the
// smallest for all ratios. So the derivatives of |J|^2 do not see that the target depends on `now`.
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
    constexpr Real height = 0.8660254037844386;  // of the equilateral triangle with sides of 1
    Triangle const before = triangle_of(points, reference);
    if (cell[number].is_part) return before;
    Real const twice_area = before.twice_area();
    if (cell[number].is_quad) {
        Real const side = sqrt(twice_area);
        return with_ratio_of(now, {side, 0}, {0, side});
    }
    Real const side = sqrt(twice_area / height);
    return {{{0, 0}, {side, 0}, {0.5 * side, height * side}}};
}

}  // namespace harmorph
