// The entries of Hessians by points are 2 x 2 matrices.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// The entries are in rows: (a, b) is the first row, (c, d) the second.
struct Block {
    Real a = 0, b = 0, c = 0, d = 0;

    constexpr Vec2 operator*(Vec2 v) const noexcept {
        return {a * v.x + b * v.y, c * v.x + d * v.y};
    }
    // Adds curvature * u v^T.
    constexpr void add(Real curvature, Vec2 u, Vec2 v) noexcept {
        a += curvature * u.x * v.x;
        b += curvature * u.x * v.y;
        c += curvature * u.y * v.x;
        d += curvature * u.y * v.y;
    }
};

constexpr Block operator+(Block p, Block q) noexcept {
    return {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d};
}
constexpr Block operator-(Block p, Block q) noexcept {
    return {p.a - q.a, p.b - q.b, p.c - q.c, p.d - q.d};
}
constexpr Block transpose(Block p) noexcept { return {p.a, p.c, p.b, p.d}; }

// Returns the block that maps v, as a complex number, to t v + c conj(v). The block is symmetric if
// t is real.
constexpr Block complex_block(Vec2 t, Vec2 c) noexcept {
    return {t.x + c.x, c.y - t.y, c.y + t.y, t.x - c.x};
}

// For a block that is a sum of products u v^T, these functions return the block in which each u, or
// each v, is turned, which is a multiplication by a complex number.
constexpr Block turned_rows(Vec2 turn, Block p) noexcept {
    Vec2 const first = product(turn, {p.a, p.c}), second = product(turn, {p.b, p.d});
    return {first.x, second.x, first.y, second.y};
}
constexpr Block turned_columns(Vec2 turn, Block p) noexcept {
    return transpose(turned_rows(turn, transpose(p)));
}

}  // namespace harmorph
