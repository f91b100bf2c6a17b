#include "harmorph/safe/untangling_energy.hpp"

namespace harmorph {
namespace {

constexpr Vec2 times_i(Vec2 a) noexcept { return {-a.y, a.x}; }
Vec2 direction(Vec2 a) noexcept {
    Real const size = length(a);
    return size > 0 ? 1 / size * a : Vec2{1, 0};
}

// The energy and its derivatives by p = |z|^2 and q = |w|^2.
struct Density {
    Real scale, p, q, by_p, by_q, by_pp, by_qq, by_pq;

    Density(Real its_p, Real its_q, Real determinant, Real softness) noexcept : p(its_p), q(its_q) {
        Real const weight = Distortion::size_weight;
        Real const root = square_root(softness * softness + determinant * determinant);
        Real const numerator = 2 * (p + q) + weight * (determinant * determinant + 1);
        scale = 1 / regularised(determinant, softness);
        Real const slope = -scale / root, bend = 2 / (root * root * root);  // of 1 / chi by the determinant
        Real const grow = 2 + 2 * weight * determinant;    // of the numerator by p
        Real const shrink = 2 - 2 * weight * determinant;  // and by q
        by_p = grow * scale + numerator * slope;
        by_q = shrink * scale - numerator * slope;
        by_pp = 2 * weight * scale + 2 * grow * slope + numerator * bend;
        by_qq = 2 * weight * scale - 2 * shrink * slope + numerator * bend;
        by_pq = -2 * weight * scale - 4 * weight * determinant * slope - numerator * bend;
    }
};

// Eigenvalues of a symmetric 2 x 2 matrix, and the first one's direction.
struct Eigen {
    Real value[2];
    Vec2 axis;

    Eigen(Real a, Real b, Real c) noexcept {  // a b; b c
        Real const mean = 0.5 * (a + c), half = 0.5 * (a - c), radius = square_root(half * half + b * b);
        value[0] = mean + radius;
        value[1] = mean - radius;
        axis = direction(half >= 0 ? Vec2{half + radius, b} : Vec2{b, radius - half});
    }
};

}  // namespace

Distortion::Distortion(Triangle const& reference) noexcept : twice_area_(reference.twice_area()) {
    Vec2 const side = reference.at[1] - reference.at[0], next = reference.at[2] - reference.at[1];
    Real const half = 0.5 / twice_area_;
    first_ = half * times_i(conjugate(next));
    second_ = -half * times_i(conjugate(side));
}

Real Distortion::energy(Triangle const& now, Real softness) const noexcept {
    Vec2 const side = now.at[1] - now.at[0], next = now.at[2] - now.at[1];
    Vec2 const z = product(first_, side) + product(second_, next);
    Vec2 const w = product(conjugate(first_), side) + product(conjugate(second_), next);
    Real const d = determinant(now);
    return (2 * (square(z) + square(w)) + size_weight * (d * d + 1)) / regularised(d, softness);
}

void Distortion::differentiate(Triangle const& now, Real softness, Real least, Vec2 (&gradient)[3],
                               Mode (&mode)[4]) const noexcept {
    Vec2 const side = now.at[1] - now.at[0], next = now.at[2] - now.at[1];
    Vec2 const z = product(first_, side) + product(second_, next);
    Vec2 const w = product(conjugate(first_), side) + product(conjugate(second_), next);
    Density const its(square(z), square(w), determinant(now), softness);
    // A change of z and w as one of the points: the transpose of the map from points to z and w.
    auto const pull_back = [&](Vec2 by_z, Vec2 by_w, Vec2 (&at)[3]) {
        Vec2 const by_side = product(conjugate(first_), by_z) + product(first_, by_w);
        Vec2 const by_next = product(conjugate(second_), by_z) + product(second_, by_w);
        at[0] = -1 * by_side;
        at[1] = by_side - by_next;
        at[2] = by_next;
    };
    pull_back(2 * its.by_p * z, 2 * its.by_q * w, gradient);

    // Turning z or w leaves p and q; growing them couples the two.
    Vec2 const along_z = direction(z), along_w = direction(w);
    Eigen const growth(2 * its.by_p + 4 * its.p * its.by_pp, 4 * square_root(its.p * its.q) * its.by_pq,
                       2 * its.by_q + 4 * its.q * its.by_qq);
    Real const curvature[4] = {2 * its.by_p, 2 * its.by_q, growth.value[0], growth.value[1]};
    for (Index k = 0; k < 4; ++k) mode[k].curvature = larger(curvature[k], least * 4 * its.scale);
    pull_back(times_i(along_z), {}, mode[0].at);
    pull_back({}, times_i(along_w), mode[1].at);
    pull_back(growth.axis.x * along_z, growth.axis.y * along_w, mode[2].at);
    pull_back(-growth.axis.y * along_z, growth.axis.x * along_w, mode[3].at);
}

}  // namespace harmorph
