// What a function is at a point: the linear map from its control point's movement to the mesh
// point's.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// The numbers of one value, by which the kinds are also numbered. Rows keep them plane after plane:
// the first numbers of all functions, then the second ones.
//   real     f               dX = f dP
//   complex  a, b            dX = (a + i b) dP, points of the plane as complex numbers
//   matrix   xx, xy, yx, yy  dX = [xx xy; yx yy] dP
enum class ValueKind : std::int32_t { real = 1, complex = 2, matrix = 4 };

constexpr Index numbers_of(ValueKind kind) noexcept { return static_cast<Index>(kind); }

// What a 1 in one plane, and 0 in the others, makes of a movement.
constexpr Vec2 moved_by(ValueKind kind, Index plane, Vec2 move) noexcept {
    if (kind != ValueKind::matrix) return plane == 0 ? move : Vec2{-move.y, move.x};
    Real const from = plane % 2 == 0 ? move.x : move.y;
    return plane < 2 ? Vec2{from, 0} : Vec2{0, from};
}

// The numbers of a complex value: plane[k], k < numbers_of(kind). For kind real, the imaginary part
// must be 0.
struct Numbers {
    Real plane[4];
};
constexpr Numbers numbers_of(ValueKind kind, Vec2 value) noexcept {
    if (kind == ValueKind::matrix) return {{value.x, -value.y, value.y, value.x}};
    return {{value.x, value.y, 0, 0}};
}

}  // namespace harmorph
