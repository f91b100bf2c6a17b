// Defines points of space, and a strided view of the caller's three coordinates.
// tests/base/test_scalar.cpp covers this file.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

struct Vec3 {
    Real x = 0, y = 0, z = 0;

    constexpr Real operator[](Index axis) const noexcept {
        return axis == 0 ? x : axis == 1 ? y : z;
    }
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(Real s, Vec3 a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
constexpr Real dot(Vec3 a, Vec3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr Vec3 unit_vector(Index axis) noexcept {
    return {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
}

// The vector is scaled first, because squares of its coordinates may overflow or underflow.
inline Real length(Vec3 a) noexcept {
    Real const size = max(max(abs(a.x), abs(a.y)), abs(a.z));
    if (!(size > 0)) return size;
    Vec3 const scaled = {a.x / size, a.y / size, a.z / size};
    return size * sqrt(dot(scaled, scaled));
}
// Returns the vector of length 1 in the direction of a; the zero vector has the direction 0.
inline Vec3 direction(Vec3 a) noexcept {
    Real const size = length(a);
    return size > 0 ? Vec3{a.x / size, a.y / size, a.z / size} : Vec3{};
}

// A view of the caller's coordinates: point k has the coordinates x[k * stride], y[k * stride] and
// z[k * stride].
template <class T>
struct StridedSpacePoints {
    T* x = nullptr;
    T* y = nullptr;
    T* z = nullptr;
    std::ptrdiff_t stride = 1;

    bool given() const noexcept { return x != nullptr; }
    Vec3 operator[](Index k) const noexcept {
        return {x[k * stride], y[k * stride], z[k * stride]};
    }
    void set(Index k, Vec3 p) const noexcept {
        x[k * stride] = p.x;
        y[k * stride] = p.y;
        z[k * stride] = p.z;
    }
};
using SpacePoints = StridedSpacePoints<const Real>;
using MutableSpacePoints = StridedSpacePoints<Real>;

}  // namespace harmorph
