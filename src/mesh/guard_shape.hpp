// The triangles of cells and guards as they are judged:
// a guard's first side is turned by the angle that its corner may bend.
#pragma once

#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Exterior angles t of a corner may be -d < t < pi - d with d = 0, 45 or 135 degrees for a corner
// that was convex, flat, or reflex: sin(t + d) > 0, so the triangle whose first side is turned back
// by d has a positive area. The turned point is a linear function of the points, so areas remain
// quadratic along a displacement.
constexpr Vec2 turn_of(CornerKind kind) noexcept {
    constexpr Real half = 0.7071067811865476;
    return kind == CornerKind::convex ? Vec2{1, 0}
           : kind == CornerKind::flat ? Vec2{half, half}
                                      : Vec2{-half, half};
}
inline Vec2 turn_of(Mesh const& mesh, Index i) noexcept {
    return i < mesh.n_cells ? Vec2{1, 0} : turn_of(mesh.guard_kind[i - mesh.n_cells]);
}

// corner - first side, turned back.
constexpr Vec2 turned_start(Vec2 start, Vec2 corner, Vec2 turn) noexcept {
    return turn.x == 1 ? start : corner - product(conjugate(turn), corner - start);
}

// A guard seen from its corner: where points are far away, or move far together, the turned side
// keeps the digits of the difference of its two points.
constexpr void turn_guard(CellShape& shape, Vec2 turn) noexcept {
    Vec2 const corner = shape.at[1];
    for (Vec2& at : shape.at) at = at - corner;
    shape.at[0] = shape.at[3] = turned_start(shape.at[0], shape.at[1], turn);
}

// Of cell or guard i, counter-clockwise; of positions, or of displacements.
inline CellShape shape_of(OrientedMesh const& cells, Index i, Points points) noexcept {
    CellShape shape(cells.cell(i), points, false);
    if (i >= cells.mesh.n_cells) turn_guard(shape, turn_of(cells.mesh, i));
    return shape;
}

}  // namespace harmorph
