// Defines points of the plane, signed areas, and a strided view of the caller's coordinates.
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

// These three functions treat vectors as complex numbers x + i y.
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

}  // namespace harmorph
