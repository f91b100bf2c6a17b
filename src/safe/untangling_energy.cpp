#include "safe/untangling_energy.hpp"

namespace harmorph {

Real Distortion::energy(Triangle const& now, Real softness) const noexcept {
    Real const d = determinant(now), chi = regularised(d, softness);
    if (chi == 0) return infinity;  // a division by 0 would trap if the caller traps exceptions
    return (2 * (square(map_.z(now)) + square(map_.w(now))) + size_weight * (d * d + 1)) / chi;
}

DensityDerivatives Distortion::derivatives(Triangle const& now, Real softness) const noexcept {
    Real const p = square(map_.z(now)), q = square(map_.w(now)), d = determinant(now);
    Real const root = sqrt(softness * softness + d * d);
    Real const numerator = 2 * (p + q) + size_weight * (d * d + 1);
    Real const scale = 1 / regularised(d, softness);
    // The first and the second derivative of 1 / chi by the determinant.
    Real const slope = -scale / root, bend = 2 / (root * root * root);
    Real const grow = 2 + 2 * size_weight * d;    // the derivative of the numerator by p
    Real const shrink = 2 - 2 * size_weight * d;  // the derivative of the numerator by q
    DensityDerivatives by;
    by.by_p = grow * scale + numerator * slope;
    by.by_q = shrink * scale - numerator * slope;
    by.by_pp = 2 * size_weight * scale + 2 * grow * slope + numerator * bend;
    by.by_qq = 2 * size_weight * scale - 2 * shrink * slope + numerator * bend;
    by.by_pq = -2 * size_weight * scale - 4 * size_weight * d * slope - numerator * bend;
    by.unit = 4 * scale;
    return by;
}

}  // namespace harmorph
