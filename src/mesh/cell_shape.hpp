// The corners, sides and areas of one cell, gathered once.
#pragma once

#include "base/predicates.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// Points in order round the cell, counter-clockwise where the cell is not inverted; n is 3 or 4.
struct CellShape {
    Index n;
    Vec2 at[4];

    CellShape(Cell const& cell, Points points, bool reversed) noexcept : n(cell.n) {
        for (Index k = 0; k < n; ++k)
            at[k] = points[reversed ? cell.point[n - 1 - k] : cell.point[k]];
        if (n == 3) at[3] = at[0];
    }
};

// Sides from each corner to the next, and twice the signed area of each corner: the cross product
// of the two sides there. A triangle has one area for all corners.
struct CellCorners {
    Vec2 side[4];
    Real twice_area[4];

    explicit CellCorners(CellShape const& shape) noexcept {
        if (shape.n == 3) {
            for (Index k = 0; k < 3; ++k) side[k] = shape.at[k + 1] - shape.at[k];
            twice_area[0] = twice_area[1] = twice_area[2] = twice_area[3] = cross(side[0], side[1]);
            return;
        }
        for (Index k = 0; k < 4; ++k) side[k] = shape.at[(k + 1) & 3] - shape.at[k];
        for (Index k = 0; k < 4; ++k) twice_area[k] = cross(side[(k + 3) & 3], side[k]);
    }
    // NaN if any corner's is NaN or infinite: a minimum alone may lose that, the sum does not.
    Real smallest() const noexcept {
        Real const sum = (twice_area[0] + twice_area[1]) + (twice_area[2] + twice_area[3]),
                   zero = sum - sum;
        if (zero != 0) return zero;
        return min(min(twice_area[0], twice_area[1]), min(twice_area[2], twice_area[3]));
    }
    // Of the sides: the square of the longest one.
    Real longest_square(Index n) const noexcept {
        Real const three = max(max(square(side[0]), square(side[1])), square(side[2]));
        return n == 3 ? three : max(three, square(side[3]));
    }
    // Of the corners: twice the area divided by the longer of the two sides. Corners have to be
    // positive.
    Real smallest_height(Index n) const noexcept {
        Real least = infinity;
        for (Index k = 0; k < n; ++k) {
            Index const before = k == 0 ? n - 1 : k - 1;
            least = min(least, twice_area[k] / sqrt(max(square(side[before]), square(side[k]))));
        }
        return least;
    }
    // Of the whole cell.
    Real cell_area(Index n) const noexcept {
        return 0.5 * (n == 3 ? twice_area[0] : twice_area[0] + twice_area[2]);
    }
};

// Of areas and squares of lengths between these, products of six are numbers, with all their
// digits.
inline constexpr Real smallest_of_products = 0x1p-150, largest_of_products = 0x1p150;

// The least height that a cell at coordinates of this size may have. A movement rounds each
// coordinate by up to 2^-53 of its size, which changes a height by no more than 2^-50 of that: 16
// such changes do not turn a corner over.
inline Real resolved_height(Real size) noexcept { return max(0x1p-46 * size, smallest_height); }
inline Real resolved_height(CellShape const& shape) noexcept {
    Real size = 0;
    for (Index k = 0; k < shape.n; ++k) size = max(size, largest_of(shape.at[k]));
    return resolved_height(size);
}

// A corner has no positive area, or a coordinate is not finite.
inline bool is_inverted(CellShape const& shape) noexcept {
    return !(CellCorners(shape).smallest() > 0);
}

// The same of finite coordinates, without rounding.
inline bool is_inverted_exactly(CellShape const& shape) noexcept {
    Index const n = shape.n;
    for (Index k = 0; k < (n == 3 ? 1 : 4); ++k) {
        if (orientation_sign(shape.at[k == 0 ? n - 1 : k - 1], shape.at[k],
                             shape.at[k + 1 == n ? 0 : k + 1]) <= 0)
            return true;
    }
    return false;
}

}  // namespace harmorph
