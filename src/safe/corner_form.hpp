// The gradient and the Hessian of the energy of one corner by its two sides. tests/safe/
// test_cell_form.cpp covers this file.
#pragma once

#include "safe/block.hpp"

namespace harmorph {

// The derivatives of the energy of a corner with the points p0, p1, p2, by the sides p1 - p0 and p2
// - p1. These are fewer numbers than the derivatives by the three points.
struct CornerForm {
    Vec2 by_side, by_next;
    // The Hessian, by the first and by the second side.
    Block side_side, side_next, next_next;

    // Turns derivatives by a side that is turned into derivatives by the side itself.
    void turn_back_side(Vec2 turn) noexcept {
        if (turn.x == 1) return;
        by_side = product(turn, by_side);
        side_side = turned_columns(turn, turned_rows(turn, side_side));
        side_next = turned_rows(turn, side_next);
    }
};

}  // namespace harmorph
