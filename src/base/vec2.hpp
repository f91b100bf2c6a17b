// Defines points of the plane: signed areas, rotations and angles, boxes, checks of the caller's
// numbers, and a strided view of the caller's coordinates.
#pragma once

#include <cstddef>

#include "base/scalar.hpp"

namespace harmorph {

struct Vec2 {
    Real x = 0, y = 0;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) noexcept { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) noexcept { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(Real s, Vec2 a) noexcept { return {s * a.x, s * a.y}; }
constexpr Real dot(Vec2 a, Vec2 b) noexcept { return a.x * b.x + a.y * b.y; }
constexpr Real cross(Vec2 a, Vec2 b) noexcept { return a.x * b.y - a.y * b.x; }
constexpr Real square(Vec2 a) noexcept { return dot(a, a); }

// The next three functions treat vectors as complex numbers x + i y.
constexpr Vec2 conjugate(Vec2 a) noexcept { return {a.x, -a.y}; }
constexpr Vec2 product(Vec2 a, Vec2 b) noexcept {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}
constexpr Vec2 quotient(Vec2 a, Vec2 b) noexcept {
    return (1 / square(b)) * product(a, conjugate(b));
}

constexpr Real largest_of(Vec2 a) noexcept { return max(abs(a.x), abs(a.y)); }
inline Real length(Vec2 a) noexcept { return sqrt(square(a)); }

// The bounds of coordinates and cell heights for which no operation overflows or underflows: third
// powers of both are normal numbers, and no formula multiplies more than three lengths before it
// divides.
inline constexpr Real largest_coordinate = 1e100, smallest_height = 1e-100;
// Returns false if a coordinate is NaN.
constexpr bool is_in_range(Vec2 p) noexcept {
    return abs(p.x) <= largest_coordinate && abs(p.y) <= largest_coordinate;
}

// Returns the area of the triangle a, b, c, which is positive if a, b, c run counter-clockwise.
constexpr Real triangle_area(Vec2 a, Vec2 b, Vec2 c) noexcept { return 0.5 * cross(b - a, c - a); }

// A view of the caller's coordinates: point k has the coordinates x[k * stride] and y[k * stride].
template <class T>
struct StridedPoints {
    T* x = nullptr;
    T* y = nullptr;
    std::ptrdiff_t stride = 1;

    constexpr operator StridedPoints<const T>() const noexcept { return {x, y, stride}; }

    bool given() const noexcept { return x != nullptr; }
    Vec2 operator[](Index k) const noexcept { return {x[k * stride], y[k * stride]}; }
    void set(Index k, Vec2 p) const noexcept {
        x[k * stride] = p.x;
        y[k * stride] = p.y;
    }
};
using Points = StridedPoints<const Real>;
using MutablePoints = StridedPoints<Real>;

// Checks that numbers of the caller are finite and in range. The bits are tested before the numbers
// are compared: a comparison with NaN would raise a floating-point exception, which callers may
// trap.

// All three functions return false for NaN.
inline bool is_at_most(Real x, Real size) noexcept { return is_finite(x) && abs(x) <= size; }
inline bool is_between(Real low, Real x, Real high) noexcept {
    return is_finite(x) && low <= x && x <= high;
}
inline bool is_coordinate(Vec2 p) noexcept {
    return is_finite(p.x) && is_finite(p.y) && is_in_range(p);
}

// Computes directions, rotations and angles of vectors with square roots and a series.
inline constexpr Real pi = 3.141592653589793;

// Returns the vector of length 1 in the direction of v; the zero vector has the direction 0.
inline Vec2 direction(Vec2 v) noexcept {
    Real const size = length(v);
    return size > 0 ? Vec2{v.x / size, v.y / size} : Vec2{};
}
constexpr Vec2 left_of(Vec2 v) noexcept { return {-v.y, v.x}; }

// A rotation by an angle is the vector (cosine, sine), which is a complex number of length 1.
// rotation_between() returns the rotation from a to b, multiplied by both lengths.
constexpr Vec2 rotated(Vec2 v, Vec2 rotation) noexcept {
    return {v.x * rotation.x - v.y * rotation.y, v.x * rotation.y + v.y * rotation.x};
}
constexpr Vec2 rotated_back(Vec2 v, Vec2 rotation) noexcept {
    return rotated(v, {rotation.x, -rotation.y});
}
constexpr Vec2 rotation_between(Vec2 a, Vec2 b) noexcept { return {dot(a, b), cross(a, b)}; }

constexpr Real in_degrees(Real radians) noexcept { return radians * (180 / pi); }

// Returns the angle from the x axis to v, from -pi to pi, to a few units in the last place. The
// zero vector has the angle 0.
inline Real angle_of(Vec2 v) noexcept {
    Real const size = max(abs(v.x), abs(v.y));
    if (!(size > 0)) return 0;
    Vec2 const unit = {v.x / size, v.y / size};
    Real const r = length(unit);
    // The vector is rotated by a quarter where the tangent of half the angle would be large.
    bool const rotated = unit.x < 0;
    Real const quarter = rotated ? (unit.y < 0 ? -pi / 2 : pi / 2) : 0;
    Real const x = rotated ? abs(unit.y) : unit.x,
               y = rotated ? (unit.y < 0 ? unit.x : -unit.x) : unit.y;
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

// A box is a rectangle parallel to the axes.

// The smallest box that contains some points; without points, `low` is infinite and `high` minus
// infinite.
struct Box {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};

    void include(Vec2 p) noexcept {
        low = {min(low.x, p.x), min(low.y, p.y)};
        high = {max(high.x, p.x), max(high.y, p.y)};
    }
    void include(Box const& other) noexcept {
        include(other.low);
        include(other.high);
    }
    Vec2 size() const noexcept { return high - low; }
    // Returns the larger side.
    Real extent() const noexcept { return max(size().x, size().y); }
    Vec2 centre() const noexcept { return 0.5 * low + 0.5 * high; }
    bool meets(Box const& other) const noexcept {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y;
    }
    Real squared_distance(Vec2 p) const noexcept {
        Real const x = max(max(low.x - p.x, p.x - high.x), 0.0);
        Real const y = max(max(low.y - p.y, p.y - high.y), 0.0);
        return x * x + y * y;
    }
};

}  // namespace harmorph
