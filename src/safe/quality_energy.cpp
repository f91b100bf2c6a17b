#include "harmorph/safe/quality_energy.hpp"

namespace harmorph {

Real QualityEnergy::energy(Triangle const& now, Index power) const noexcept {
    Real const d = map_.determinant(now);
    if (!(d > 0)) return infinity;
    Real const shape = (square(map_.z(now)) + square(map_.w(now))) / d, size = 0.5 * (d + 1 / d);
    return power_of(shape * shape * size, power);
}

// Of the logarithm 2 ln s - 2 ln d + ln (d + 1/d) first, with s = p + q and d = p - q.
void QualityEnergy::differentiate(Triangle const& now, Index power, Real weight, Real least, Vec2 (&gradient)[3],
                                  CornerMode (&mode)[4]) const noexcept {
    Real const d = map_.determinant(now), s = square(map_.z(now)) + square(map_.w(now));
    Real const scale = weight * static_cast<Real>(power) * energy(now, power);
    Real const square_of_d = d * d, below = d * (square_of_d + 1);
    Real const by_s = 2 / s, by_ss = -2 / (s * s);
    Real const by_d = (square_of_d - 1) / below - 2 / d;
    Real const by_dd = (1 + 4 * square_of_d - square_of_d * square_of_d) / (below * below) + 2 / square_of_d;
    Real const by_p = by_s + by_d, by_q = by_s - by_d, n = static_cast<Real>(power);
    DensityDerivatives const by{scale * by_p, scale * by_q, scale * (by_ss + by_dd + n * by_p * by_p),
                                scale * (by_ss + by_dd + n * by_q * by_q), scale * (by_ss - by_dd + n * by_p * by_q)};
    map_.differentiate(now, by, least * 4 * scale, gradient, mode);
}

}  // namespace harmorph
