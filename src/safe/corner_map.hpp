// The linear map that deforms a corner of a cell, and derivatives of energies of that map by the
// three points of the corner.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// A triangle of three points. The second point is the corner of the cell that the triangle
// represents.
struct Triangle {
    Vec2 at[3];

    constexpr Real twice_area() const noexcept { return cross(at[1] - at[0], at[2] - at[1]); }
};

// One direction of a Hessian in the space of the three points; the term of the Hessian is curvature
// * (at at^T).
struct CornerMode {
    Real curvature;
    Vec2 at[3];
};

// The derivatives of an energy by p = |z|^2 and q = |w|^2.
struct DensityDerivatives {
    Real by_p, by_q, by_pp, by_qq, by_pq;
};

constexpr Vec2 times_i(Vec2 a) noexcept { return {-a.y, a.x}; }
constexpr Vec2 direction_or_x(Vec2 a, Real size) noexcept {
    return size > 0 ? 1 / size * a : Vec2{1, 0};
}
inline Vec2 direction_or_x(Vec2 a) noexcept { return direction_or_x(a, length(a)); }

// The eigenvalues of a symmetric 2 x 2 matrix, and the direction of the first one.
struct Eigen {
    Real value[2];
    Vec2 axis;

    Eigen(Real a, Real b, Real c) noexcept {  // the matrix is (a, b; b, c)
        Real const mean = 0.5 * (a + c), whole = 0.5 * (a - c);
        // Derivatives of cells that have nearly collapsed are so large that their squares would
        // overflow.
        bool const is_large = max(abs(whole), abs(b)) > 0x1p500;
        Real const unit = is_large ? 0x1p512 : 1, per_unit = is_large ? 0x1p-512 : 1;
        Real const half = per_unit * whole, part = per_unit * b,
                   radius = sqrt(half * half + part * part);
        value[0] = mean + unit * radius;
        value[1] = mean - unit * radius;
        axis = half >= 0 ? direction_or_x({half + radius, part})
                         : direction_or_x({part, radius - half});
    }
};

// The linear map J from the reference triangle to another one, in complex numbers: J dX = z dX + w
// conj(dX), so that |J|^2 = 2 p + 2 q and det J = p - q with p = |z|^2 and q = |w|^2. An energy
// that does not change when either triangle turns is a function of p and q.
class CornerMap {
public:
    explicit CornerMap(Triangle const& reference) noexcept;

    Real twice_area() const noexcept { return twice_area_; }  // of the reference triangle
    Real determinant(Triangle const& now) const noexcept { return now.twice_area() / twice_area_; }
    Vec2 z(Triangle const& now) const noexcept {
        return product(first_, now.at[1] - now.at[0]) + product(second_, now.at[2] - now.at[1]);
    }
    Vec2 w(Triangle const& now) const noexcept {
        return product(conjugate(first_), now.at[1] - now.at[0]) +
               product(conjugate(second_), now.at[2] - now.at[1]);
    }
    // Finds the derivatives by the three points. The Hessian is the sum of the modes, which are
    // orthogonal as changes of J. Curvatures below `least` are raised to `least`.
    void differentiate(Triangle const& now, DensityDerivatives const& by, Real least,
                       Vec2 (&gradient)[3], CornerMode (&mode)[4]) const noexcept;

private:
    void pull_back(Vec2 by_z, Vec2 by_w, Vec2 (&at)[3]) const noexcept;

    Vec2 first_, second_;  // z = first_ * (at[1] - at[0]) + second_ * (at[2] - at[1]); w the same
                           // with their conjugates
    Real twice_area_;
};

inline CornerMap::CornerMap(Triangle const& reference) noexcept
    : twice_area_(reference.twice_area()) {
    Vec2 const side = reference.at[1] - reference.at[0], next = reference.at[2] - reference.at[1];
    Real const half = 0.5 / twice_area_;
    first_ = half * times_i(conjugate(next));
    second_ = -half * times_i(conjugate(side));
}

// Turns a change by z and w into a change by the points: this is the transpose of the map from
// points to z and w.
inline void CornerMap::pull_back(Vec2 by_z, Vec2 by_w, Vec2 (&at)[3]) const noexcept {
    Vec2 const by_side = product(conjugate(first_), by_z) + product(first_, by_w);
    Vec2 const by_next = product(conjugate(second_), by_z) + product(second_, by_w);
    at[0] = -1 * by_side;
    at[1] = by_side - by_next;
    at[2] = by_next;
}

inline void CornerMap::differentiate(Triangle const& now, DensityDerivatives const& by, Real least,
                                     Vec2 (&gradient)[3], CornerMode (&mode)[4]) const noexcept {
    Vec2 const z_now = z(now), w_now = w(now);
    Real const p = square(z_now), q = square(w_now);
    pull_back(2 * by.by_p * z_now, 2 * by.by_q * w_now, gradient);

    // Turning z or w changes neither p nor q, and scaling couples the two.
    Real const size_of_z = sqrt(p), size_of_w = sqrt(q);
    Vec2 const along_z = direction_or_x(z_now, size_of_z),
               along_w = direction_or_x(w_now, size_of_w);
    Eigen const growth(2 * by.by_p + 4 * p * by.by_pp, 4 * size_of_z * size_of_w * by.by_pq,
                       2 * by.by_q + 4 * q * by.by_qq);
    Real const curvature[4] = {2 * by.by_p, 2 * by.by_q, growth.value[0], growth.value[1]};
    for (Index k = 0; k < 4; ++k) mode[k].curvature = max(curvature[k], least);
    pull_back(times_i(along_z), {}, mode[0].at);
    pull_back({}, times_i(along_w), mode[1].at);
    pull_back(growth.axis.x * along_z, growth.axis.y * along_w, mode[2].at);
    pull_back(-growth.axis.y * along_z, growth.axis.x * along_w, mode[3].at);
}

}  // namespace harmorph
