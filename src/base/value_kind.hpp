// The value of a function at a mesh point is the linear map from the movement of the control point
// to the movement of the mesh point.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// Each kind is the count of numbers in one value. Rows store values in planes: the first numbers of
// all functions, then the second numbers, and so on.
//   real     f               dX = f dP
//   complex  a, b            dX = (a + i b) dP, where points are complex numbers
//   matrix   xx, xy, yx, yy  dX = [xx xy; yx yy] dP
enum class ValueKind : std::int32_t { real = 1, complex = 2, matrix = 4 };

constexpr Index numbers_of(ValueKind kind) noexcept { return static_cast<Index>(kind); }

// Returns the displacement dX for the movement dP = move and a value that is 1 in this plane and 0
// in the others.
constexpr Vec2 moved_by(ValueKind kind, Index plane, Vec2 move) noexcept {
    if (kind != ValueKind::matrix) return plane == 0 ? move : Vec2{-move.y, move.x};
    Real const from = plane % 2 == 0 ? move.x : move.y;
    return plane < 2 ? Vec2{from, 0} : Vec2{0, from};
}

// Holds the numbers of a complex value in plane[k], k < numbers_of(kind). For the kind `real`, the
// imaginary part must be 0.
struct Numbers {
    Real plane[4];
};
constexpr Numbers numbers_of(ValueKind kind, Vec2 value) noexcept {
    if (kind == ValueKind::matrix) return {{value.x, -value.y, value.y, value.x}};
    return {{value.x, value.y, 0, 0}};
}

}  // namespace harmorph
