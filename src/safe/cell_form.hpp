// The gradient and the Hessian of the energy of one cell by the points of the cell, summed from
// those of the corners.
#pragma once

#include "mesh/mesh.hpp"
#include "safe/corner_form.hpp"

namespace harmorph {

// The derivatives of the energy of a cell with n points; the Hessian is symmetric.
template <Index n>
struct CellForm {
    static constexpr Index count = n;
    Vec2 by[n];
    Block hessian[n][n];
    // The gradient of the energy is slope * by; see also NewtonSystem::border.
    Real slope = 1, curvature = 0;

    // Adds the derivatives of the corner at point `own`, the sides of which go from point `before`
    // to point `own` and from there to point `after`.
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
