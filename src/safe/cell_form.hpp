// The gradient and the Hessian of the energy of one cell by the points of the cell, summed from
// those of the corners.
#pragma once

#include "mesh/mesh.hpp"
#include "safe/block.hpp"
#include "safe/corner_map.hpp"

namespace harmorph {

// The derivatives of the energy of a corner with the points p0, p1, p2, by the sides p1 - p0 and p2
// - p1. These are fewer numbers than the derivatives by the three points.
struct CornerForm {
    Vec2 by_side, by_next;
    // The Hessian, by the first and by the second side.
    Block side_side, side_next, next_next;

    // Adds a term in the form that CornerMap::differentiate() gives.
    void add(const Vec2 (&gradient)[3], const CornerMode (&mode)[4]) noexcept {
        by_side = by_side - gradient[0];
        by_next = by_next + gradient[2];
        for (CornerMode const& corner_mode : mode) {
            Vec2 const side = -1 * corner_mode.at[0], next = corner_mode.at[2];
            side_side.add(corner_mode.curvature, side, side);
            side_next.add(corner_mode.curvature, side, next);
            next_next.add(corner_mode.curvature, next, next);
        }
    }
    // Turns derivatives by a side that is turned into derivatives by the side itself.
    void turn_back_side(Vec2 turn) noexcept {
        if (turn.x == 1) return;
        by_side = product(turn, by_side);
        side_side = turned_columns(turn, turned_rows(turn, side_side));
        side_next = turned_rows(turn, side_next);
    }
};

// The derivatives of the energy of a cell with n points; the Hessian is symmetric.
template <Index n>
struct CellForm {
    Vec2 by[n];
    Block hessian[n][n];

    // Adds those of the corner at point `own`, which goes from point `before` to point `after`.
    void add(Index before, Index own, Index after, CornerForm const& corner) noexcept {
        by[before] = by[before] - corner.by_side;
        by[own] = by[own] + (corner.by_side - corner.by_next);
        by[after] = by[after] + corner.by_next;
        Block const cross = corner.side_next, turned = transpose(cross);
        Block const side = corner.side_side, next = corner.next_next;
        hessian[before][before] = hessian[before][before] + side;
        hessian[before][own] = hessian[before][own] + (cross - side);
        hessian[before][after] = hessian[before][after] - cross;
        hessian[own][before] = hessian[own][before] + (turned - side);
        hessian[own][own] = hessian[own][own] + (side - (cross + turned) + next);
        hessian[own][after] = hessian[own][after] + (cross - next);
        hessian[after][before] = hessian[after][before] - turned;
        hessian[after][own] = hessian[after][own] + (turned - next);
        hessian[after][after] = hessian[after][after] + next;
    }
    // Turns derivatives by points into derivatives by the unknowns that move the points; see
    // Tangle::turn.
    void turn_back(Span<const Vec2> turn, Cell const& cell) noexcept {
        for (Index own = 0; own < n; ++own) {
            Vec2 const back = conjugate(turn[cell.point[own]]);
            by[own] = product(back, by[own]);
            for (Index other = 0; other < n; ++other) {
                hessian[own][other] = turned_rows(back, hessian[own][other]);
                hessian[other][own] = turned_columns(back, hessian[other][own]);
            }
        }
    }
};

}  // namespace harmorph
