// Computes directions, turns and angles of vectors with square roots and a series.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

inline constexpr Real pi = 3.141592653589793;

// Returns the vector of length 1 in the direction of v; the zero vector has the direction 0.
inline Vec2 direction(Vec2 v) noexcept {
    Real const size = length(v);
    return size > 0 ? Vec2{v.x / size, v.y / size} : Vec2{};
}
constexpr Vec2 left_of(Vec2 v) noexcept { return {-v.y, v.x}; }

// A turn by an angle is the vector (cosine, sine), which is a complex number of length 1.
// turn_between() returns the turn from a to b, multiplied by both lengths.
constexpr Vec2 turned(Vec2 v, Vec2 turn) noexcept {
    return {v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x};
}
constexpr Vec2 turned_back(Vec2 v, Vec2 turn) noexcept { return turned(v, {turn.x, -turn.y}); }
constexpr Vec2 turn_between(Vec2 a, Vec2 b) noexcept { return {dot(a, b), cross(a, b)}; }

constexpr Real in_degrees(Real radians) noexcept { return radians * (180 / pi); }

// Returns the angle from the x axis to v, from -pi to pi, to a few units in the last place. The
// zero vector has the angle 0.
inline Real angle_of(Vec2 v) noexcept {
    Real const size = max(abs(v.x), abs(v.y));
    if (!(size > 0)) return 0;
    Vec2 const unit = {v.x / size, v.y / size};
    Real const r = length(unit);
    // The vector is turned by a quarter where the tangent of half the angle would be large.
    bool const turned = unit.x < 0;
    Real const quarter = turned ? (unit.y < 0 ? -pi / 2 : pi / 2) : 0;
    Real const x = turned ? abs(unit.y) : unit.x,
               y = turned ? (unit.y < 0 ? unit.x : -unit.x) : unit.y;
    Real t = y / (r + x), factor = 2;
    // Each step halves the angle. Gregory's series then follows; the omitted terms are below
    // 0.06^14 / 15.
    for (; abs(t) > 0.06; factor *= 2) t /= 1 + sqrt(1 + t * t);
    Real const s = t * t;
    Real const series =
        1 - s * (1.0 / 3 -
                 s * (1.0 / 5 - s * (1.0 / 7 - s * (1.0 / 9 - s * (1.0 / 11 - s * (1.0 / 13))))));
    return quarter + factor * t * series;
}

}  // namespace harmorph
