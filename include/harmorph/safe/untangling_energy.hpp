// How far a triangle is from the shape and size of a reference: an energy that stays finite when it is folded.
// V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov: Foldover-free maps in 50 lines of code,
// ACM Trans. Graph. 40 (2021), eqs. 2-4.
#pragma once

#include "harmorph/base/vec2.hpp"

namespace harmorph {

// Three points; the second is the corner of the cell that the triangle stands for.
struct Triangle {
    Vec2 at[3];

    constexpr Real twice_area() const noexcept { return cross(at[1] - at[0], at[2] - at[1]); }
};

// Positive for every determinant, and nearly it where that is large; increases with it. softness 0: the positive part.
inline Real regularised(Real determinant, Real softness) noexcept {
    Real const root = square_root(softness * softness + determinant * determinant);
    return determinant > 0 ? 0.5 * (determinant + root) : 0.5 * softness * softness / (root - determinant);
}

// The linear map J from the reference triangle to another one, in complex numbers: J dX = z dX + w conj(dX), so that
// |J|^2 = 2 |z|^2 + 2 |w|^2 and det J = |z|^2 - |w|^2. Energy, with chi the regularised determinant:
//     (|J|^2 + size_weight (det^2 + 1)) / chi
struct Distortion {
    static constexpr Real size_weight = 0.1;

    // One direction of the Hessian in the space of the three points: curvature * (at at^T).
    struct Mode {
        Real curvature;
        Vec2 at[3];
    };

    explicit Distortion(Triangle const& reference) noexcept;

    Real determinant(Triangle const& now) const noexcept { return now.twice_area() / twice_area_; }
    Real energy(Triangle const& now, Real softness) const noexcept;
    // Derivatives by the three points. The Hessian is the sum of the modes, which are orthogonal as changes of J.
    // Curvatures below `least` times that of |J|^2 / chi are raised to it: from 0 on, no mode is negative.
    void differentiate(Triangle const& now, Real softness, Real least, Vec2 (&gradient)[3],
                       Mode (&mode)[4]) const noexcept;

private:
    Vec2 first_, second_;  // z = first_ * (at[1] - at[0]) + second_ * (at[2] - at[1]); w the same with their conjugates
    Real twice_area_;
};

}  // namespace harmorph
