// Computes the corners, sides and areas of one cell. tests/mesh/test_orientation.cpp and
// tests/morph/test_quality.cpp cover this file.
#pragma once

#include "base/predicates.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// The n corners are in counter-clockwise order, unless the cell is inverted; n is 3 or 4.
struct CellShape {
    Index n;
    Vec2 at[4];

    CellShape(Cell const& cell, Points points, bool reversed) noexcept : n(cell.n) {
        for (Index k = 0; k < n; ++k)
            at[k] = points[reversed ? cell.point[n - 1 - k] : cell.point[k]];
        if (n == 3) at[3] = at[0];
    }
};

// Each side runs from a corner to the next one. The area of a corner is the signed area of the
// triangle of the corner and its two neighbours, half the cross product of the two sides there. All
// corners of a triangle have the same area.
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
    // Returns the smallest of twice_area, or NaN if any of them is NaN or infinite. The sum finds
    // such numbers, because a minimum may drop NaN.
    Real smallest() const noexcept {
        Real const sum = (twice_area[0] + twice_area[1]) + (twice_area[2] + twice_area[3]),
                   zero = sum - sum;
        if (zero != 0) return zero;
        return min(min(twice_area[0], twice_area[1]), min(twice_area[2], twice_area[3]));
    }
    // Returns the square of the length of the longest side.
    Real longest_square(Index n) const noexcept {
        Real const three = max(max(square(side[0]), square(side[1])), square(side[2]));
        return n == 3 ? three : max(three, square(side[3]));
    }
    // The height of a corner is twice its area divided by the longer of the two sides. Returns the
    // smallest height; all areas must be positive.
    Real smallest_height(Index n) const noexcept {
        Real lowest = infinity;
        for (Index k = 0; k < n; ++k) {
            Index const before = k == 0 ? n - 1 : k - 1;
            lowest = min(lowest, twice_area[k] / sqrt(max(square(side[before]), square(side[k]))));
        }
        return lowest;
    }
    // Returns the area of the whole cell.
    Real cell_area(Index n) const noexcept {
        return 0.5 * (n == 3 ? twice_area[0] : twice_area[0] + twice_area[2]);
    }
};

// A product of six factors (areas or squared lengths) between these bounds is a normal number.
inline constexpr Real min_factor = 0x1p-150, max_factor = 0x1p150;

// Returns the smallest height that a cell may have if its coordinates have this size. A movement
// rounds each coordinate by up to 2^-53 of its size, which changes a height by at most 2^-50 of the
// size: 16 such changes do not invert a corner.
inline Real resolved_height(Real size) noexcept { return max(0x1p-46 * size, smallest_height); }
inline Real resolved_height(CellShape const& shape) noexcept {
    Real size = 0;
    for (Index k = 0; k < shape.n; ++k) size = max(size, largest_of(shape.at[k]));
    return resolved_height(size);
}

// Returns whether a corner has no positive area or a coordinate is not finite.
inline bool is_inverted(CellShape const& shape) noexcept {
    return !(CellCorners(shape).smallest() > 0);
}

// Returns whether a corner has no positive area, decided without rounding; all coordinates must be
// finite.
inline bool is_inverted_exactly(CellShape const& shape) noexcept {
    Index const n = shape.n;
    for (Index k = 0; k < (n == 3 ? 1 : 4); ++k) {
        if (orientation_sign(shape.at[k == 0 ? n - 1 : k - 1], shape.at[k],
                             shape.at[k + 1 == n ? 0 : k + 1]) <= 0)
            return true;
    }
    return false;
}

// Returns the shapes of cells and guards whose areas must be positive. The first side of a guard is
// rotated by the angle by which its corner may bend.

// The exterior angle t of a corner must satisfy -d < t < pi - d, with d = 0, 45 or 135 degrees for
// a corner that was convex, flat or reflex before the movement. Then sin(t + d) > 0, so the
// triangle whose first side is rotated back by d has a positive area. The rotated point is a linear
// function of the points, so areas remain quadratic along a displacement.
constexpr Vec2 rotation_of(CornerKind kind) noexcept {
    constexpr Real sqrt_half = 0.7071067811865476;
    return kind == CornerKind::convex ? Vec2{1, 0}
           : kind == CornerKind::flat ? Vec2{sqrt_half, sqrt_half}
                                      : Vec2{-sqrt_half, sqrt_half};
}
inline Vec2 rotation_of(Mesh const& mesh, Index i) noexcept {
    return i < mesh.n_cells ? Vec2{1, 0} : rotation_of(mesh.guard_kind[i - mesh.n_cells]);
}

// Returns the start of the first side after the side has been rotated back about the corner.
constexpr Vec2 rotated_start(Vec2 start, Vec2 corner, Vec2 rotation) noexcept {
    return rotation.x == 1 ? start : corner - product(conjugate(rotation), corner - start);
}

// Rotates the first side of a guard and moves the origin to the corner of the guard. With this
// origin, the rotated side keeps the digits of the difference of its two points, even if the points
// are far from the origin of the mesh or move far together.
constexpr void rotate_guard(CellShape& shape, Vec2 rotation) noexcept {
    Vec2 const corner = shape.at[1];
    for (Vec2& at : shape.at) at = at - corner;
    shape.at[0] = shape.at[3] = rotated_start(shape.at[0], shape.at[1], rotation);
}

// Returns the counter-clockwise shape of cell or guard i; `points` are positions or displacements.
inline CellShape shape_of(OrientedMesh const& cells, Index i, Points points) noexcept {
    CellShape shape(cells.cell(i), points, false);
    if (i >= cells.mesh.n_cells) rotate_guard(shape, rotation_of(cells.mesh, i));
    return shape;
}

}  // namespace harmorph
