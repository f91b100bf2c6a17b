// Returns the shapes of cells and guards whose areas must be positive. The first side of a guard is
// turned by the angle by which its corner may bend. tests/mesh/test_pieces.cpp covers this file.
#pragma once

#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// The exterior angle t of a corner must satisfy -d < t < pi - d, with d = 0, 45 or 135 degrees for
// a corner that was convex, flat or reflex before the movement. Then sin(t + d) > 0, so the
// triangle whose first side is turned back by d has a positive area. The turned point is a linear
// function of the points, so areas remain quadratic along a displacement.
constexpr Vec2 turn_of(CornerKind kind) noexcept {
    constexpr Real sqrt_half = 0.7071067811865476;
    return kind == CornerKind::convex ? Vec2{1, 0}
           : kind == CornerKind::flat ? Vec2{sqrt_half, sqrt_half}
                                      : Vec2{-sqrt_half, sqrt_half};
}
inline Vec2 turn_of(Mesh const& mesh, Index i) noexcept {
    return i < mesh.n_cells ? Vec2{1, 0} : turn_of(mesh.guard_kind[i - mesh.n_cells]);
}

// Returns the start of the first side after the side has been turned back about the corner.
constexpr Vec2 turned_start(Vec2 start, Vec2 corner, Vec2 turn) noexcept {
    return turn.x == 1 ? start : corner - product(conjugate(turn), corner - start);
}

// Turns the first side of a guard and moves the origin to the corner of the guard. With this
// origin, the turned side keeps the digits of the difference of its two points, even if the points
// are far from the origin of the mesh or move far together.
constexpr void turn_guard(CellShape& shape, Vec2 turn) noexcept {
    Vec2 const corner = shape.at[1];
    for (Vec2& at : shape.at) at = at - corner;
    shape.at[0] = shape.at[3] = turned_start(shape.at[0], shape.at[1], turn);
}

// Returns the counter-clockwise shape of cell or guard i; `points` are positions or displacements.
inline CellShape shape_of(OrientedMesh const& cells, Index i, Points points) noexcept {
    CellShape shape(cells.cell(i), points, false);
    if (i >= cells.mesh.n_cells) turn_guard(shape, turn_of(cells.mesh, i));
    return shape;
}

}  // namespace harmorph
