#include "harmorph/safe/quality_energy.hpp"

namespace harmorph {

// Beyond `most` derivatives could overflow: up to 4 power energy max(s, 1) / d^2, divided by the target's area.
Real QualityEnergy::energy(Triangle const& now) const noexcept {
    constexpr Real least_area = 1e-50, largest = 1e280;
    Real const d = map_.determinant(now), s = square(map_.z(now)) + square(map_.w(now));
    if (!(d > least_area * larger(1.0, s)) || !(d < 1 / least_area)) return infinity;
    Real const shape = s / d, size = 0.5 * (d + 1 / d), base = scale_ * shape * shape * size;
    Real const small = smaller(1.0, d),
               most = largest * smaller(1.0, map_.twice_area()) * small * small / larger(1.0, s);
    if (!(base <= most)) return infinity;
    Real product = base;
    for (Index k = 1; k < power_; ++k) {
        if (base > 1 && product > most / base) return infinity;
        product *= base;
    }
    return product;
}

// Of the logarithm 2 ln s - 2 ln d + ln (d + 1/d) first, with s = p + q and d = p - q.
void QualityEnergy::differentiate(Triangle const& now, Real weight, Real least, Vec2 (&gradient)[3],
                                  CornerMode (&mode)[4]) const noexcept {
    Real const d = map_.determinant(now), s = square(map_.z(now)) + square(map_.w(now));
    Real const n = static_cast<Real>(power_), scale = weight * n * energy(now);
    Real const square_of_d = d * d, below = d * (square_of_d + 1);
    Real const by_s = 2 / s, by_ss = -2 / (s * s);
    Real const by_d = (square_of_d - 1) / below - 2 / d;
    Real const by_dd = (1 + 4 * square_of_d - square_of_d * square_of_d) / (below * below) + 2 / square_of_d;
    Real const by_p = by_s + by_d, by_q = by_s - by_d;
    DensityDerivatives const by{scale * by_p, scale * by_q, scale * (by_ss + by_dd + n * by_p * by_p),
                                scale * (by_ss + by_dd + n * by_q * by_q), scale * (by_ss - by_dd + n * by_p * by_q)};
    map_.differentiate(now, by, least * 4 * scale, gradient, mode);
}

}  // namespace harmorph
