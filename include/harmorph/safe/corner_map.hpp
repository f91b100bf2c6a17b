// The linear map that a corner of a cell has undergone, and derivatives of energies of that map by the corner's three
// points.
#pragma once

#include "harmorph/base/vec2.hpp"

namespace harmorph {

// Three points; the second is the corner of the cell that the triangle stands for.
struct Triangle {
    Vec2 at[3];

    constexpr Real twice_area() const noexcept { return cross(at[1] - at[0], at[2] - at[1]); }
};

// One direction of a Hessian in the space of the three points: curvature * (at at^T).
struct CornerMode {
    Real curvature;
    Vec2 at[3];
};

// Derivatives of an energy by p = |z|^2 and q = |w|^2.
struct DensityDerivatives {
    Real by_p, by_q, by_pp, by_qq, by_pq;
};

// The linear map J from the reference triangle to another one, in complex numbers: J dX = z dX + w conj(dX), so that
// |J|^2 = 2 p + 2 q and det J = p - q with p = |z|^2 and q = |w|^2. An energy that does not change when either triangle
// turns is a function of p and q.
class CornerMap {
public:
    explicit CornerMap(Triangle const& reference) noexcept;

    Real twice_area() const noexcept { return twice_area_; }  // of the reference
    Real determinant(Triangle const& now) const noexcept { return now.twice_area() / twice_area_; }
    Vec2 z(Triangle const& now) const noexcept {
        return product(first_, now.at[1] - now.at[0]) + product(second_, now.at[2] - now.at[1]);
    }
    Vec2 w(Triangle const& now) const noexcept {
        return product(conjugate(first_), now.at[1] - now.at[0]) + product(conjugate(second_), now.at[2] - now.at[1]);
    }
    // Derivatives by the three points. The Hessian is the sum of the modes, which are orthogonal as changes of J;
    // curvatures below `least` are raised to it.
    void differentiate(Triangle const& now, DensityDerivatives const& by, Real least, Vec2 (&gradient)[3],
                       CornerMode (&mode)[4]) const noexcept;

private:
    void pull_back(Vec2 by_z, Vec2 by_w, Vec2 (&at)[3]) const noexcept;

    Vec2 first_, second_;  // z = first_ * (at[1] - at[0]) + second_ * (at[2] - at[1]); w the same with their conjugates
    Real twice_area_;
};

}  // namespace harmorph
