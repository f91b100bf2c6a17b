// The targets of the cells of a deformed mesh, and the quality that no cell should fall below.
#pragma once

#include "base/arena.hpp"
#include "boundary/distance.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"
#include "safe/corner_triangle.hpp"

namespace harmorph {

// The target of a cell is the cell of the reference mesh, with two exceptions:
//   - The targets of thin cells along walls are stretched along the wall by the factor
//         1 + thinness fade (stretch - 1),
//     because these cells must become longer where the wall becomes longer, and must keep their
//     heights. Here
//         stretch   is the length of the nearest wall face now, divided by the length before;
//         thinness  is max(0, 1 - a), where a is the extent of the reference cell normal to that
//                   face, divided by the extent along the face;
//         fade      is max(0, 1 - d / reach), where d is the distance from the wall and the reach
//                   is a quarter of the extent of all walls.
//   - The targets of quadrilaterals that are not thin have any ratio of sides: only the area and
//     the angles count, as in the quality that the library reports.
struct Targets {
    struct Cell {
        Vec2 along;       // the unit tangent of the wall before the movement
        Real more = 0;    // the factor of the stretch along the wall, minus 1
        Real area = 0;    // the area of the reference cell
        Real wanted = 0;  // the size-skew quality that the cell should have
        Real own = 1;     // the skew quality of the reference cell
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
    // An improvement raises cells up to `aim` times `wanted`. The larger the smallest quality of
    // the reference, the nearer is this factor to 1.
    Real aim = 1;

    void lay_out(Arena& arena, Index n_cells) noexcept { arena.take(cell, n_cells); }
    // The faces `walls` were built at `before`, and there may be none. All cells of `before` are
    // valid.
    void find(OrientedMesh const& cells, FaceDistance const& walls, Points before, Points now,
              Executor const& executor) noexcept;

    // Returns the target of the corner of a cell with these three points; if the cell has
    // any_ratio, with other sides of the same directions and area.
    Triangle of(Index number, CornerPoints const& points) const noexcept;
    // Returns the weight of a corner. A quadrilateral has four corners, and a polygon has more than
    // two parts for each corner.
    Real share(Index number) const noexcept {
        return cell[number].is_quad || cell[number].is_part ? 0.25 : 1;
    }
    // Returns the corner of best quality with the area of the reference corner: that of an
    // equilateral triangle, or of a rectangle, with any ratio of sides. A corner that is this one,
    // turned, has the size-skew quality 1.
    Triangle ideal(Index number, CornerPoints const& points) const noexcept;
    // Returns the size-skew quality as measure_quality() defines it; for parts of polygons it is
    // relative to the reference and at most 1.
    Real quality(Index number, CellShape const& now) const noexcept;

private:
    void find_stretch(Cell& target, CellShape const& shape, FaceDistance const& walls, Points now,
                      Index& group) const noexcept;
};

// The height of an equilateral triangle with sides of length 1.
inline constexpr Real equilateral_height = 0.8660254037844386;

inline Triangle Targets::of(Index number, CornerPoints const& points) const noexcept {
    Triangle triangle = triangle_of(points, reference);
    Cell const& target = cell[number];
    if (target.any_ratio || target.more == 0) return triangle;
    for (Vec2& at : triangle.at) at = at + target.more * dot(target.along, at) * target.along;
    return triangle;
}

inline Triangle Targets::ideal(Index number, CornerPoints const& points) const noexcept {
    Triangle const before = triangle_of(points, reference);
    if (cell[number].is_part) return before;
    Real const twice_area = before.twice_area();
    Real const side = sqrt(cell[number].is_quad ? twice_area : twice_area / equilateral_height);
    if (cell[number].is_quad) return {{{-side, 0}, {0, 0}, {0, side}}};
    return {{{0, 0}, {side, 0}, {0.5 * side, equilateral_height * side}}};
}

}  // namespace harmorph
