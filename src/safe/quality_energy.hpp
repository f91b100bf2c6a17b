// Measures the deviation of a corner from the shape and the size of its target by a power of the
// inverse quality, which is infinite for inverted corners.
#pragma once

#include "safe/corner_map.hpp"

namespace harmorph {

// With the map J from the target corner, p and q as in CornerMap, and d = det J > 0:
//   shape = |J|^2 / (2 d) = (p + q) / (p - q),   size = (d + 1/d) / 2,
//   energy = (scale shape^2 size)^power.
// Shape and size are 1 at the target, which may be turned and moved, and larger elsewhere. The
// inverse 1 / (shape sqrt(size)) is the size-skew quality relative to the target: P. M. Knupp, SIAM
// J. Sci. Comput. 23 (2001) 193, measures quality by the target matrix; 1 / size tends to 2 min(d,
// 1/d) but is smooth. So with scale = least^2 the energy is (least / quality)^(2 power).
class QualityEnergy {
public:
    // This part of the smallest natural curvature is the lower bound; rotation, which changes
    // nothing at the target, has this curvature, too.
    static constexpr Real least_curvature = 0.02;

    explicit QualityEnergy(Triangle const& target, Index power = 1, Real scale = 1) noexcept
        : map_(target), power_(power), scale_(scale) {}

    // Returns infinity if the corner has no positive area, or is so far from its target that a
    // derivative would overflow.
    Real energy(Triangle const& now) const noexcept {
        return energy(map_.sizes(now), power_, scale_);
    }
    static Real energy(MapSizes const& map, Index power, Real scale) noexcept;
    // Returns the derivatives of `weight` times the energy, which must be finite. Their unit is 4
    // power energy, the curvature of scaling at the target.
    DensityDerivatives derivatives(Triangle const& now, Real weight) const noexcept;
    // Adds the derivatives by the sides to `form`; see CornerMap.
    void differentiate(Triangle const& now, Real weight, Real least,
                       CornerForm& form) const noexcept {
        map_.differentiate(now, derivatives(now, weight), least, form);
    }
    CornerMap const& map() const noexcept { return map_; }

private:
    CornerMap map_;
    Index power_;
    Real scale_;
};

// Beyond `most` = room / max(s, 1), derivatives could overflow: they are up to 4 power energy
// max(s, 1) / d^2, divided by the area of the target.
inline Real QualityEnergy::energy(MapSizes const& map, Index power, Real scale) noexcept {
    constexpr Real least_area = 1e-50, largest = 1e280;
    Real const d = map.determinant, s = map.s, unit = max(1.0, s);
    if (!(d > least_area * unit) || !(d < 1 / least_area)) return infinity;
    Real const per_d = 1 / d, shape = s * per_d, size = 0.5 * (d + per_d),
               base = scale * shape * shape * size;
    Real const small = min(1.0, d), room = largest * min(1.0, map.twice_area) * small * small;
    if (!(base * unit <= room)) return infinity;
    Real const most_before = base > 1 && power > 1 ? room / unit / base : infinity;
    Real product = base;
    for (Index k = 1; k < power; ++k) {
        if (product > most_before) return infinity;
        product *= base;
    }
    return product;
}

// First come the derivatives of the logarithm 2 ln s - 2 ln d + ln (d + 1/d), with s = p + q and d
// = p - q.
inline DensityDerivatives QualityEnergy::derivatives(Triangle const& now,
                                                     Real weight) const noexcept {
    MapSizes const map = map_.sizes(now);
    Real const d = map.determinant, s = map.s;
    Real const n = static_cast<Real>(power_), scale = weight * n * energy(map, power_, scale_);
    Real const square_of_d = d * d, per_d = 1 / d, per_below = per_d * (1 / (square_of_d + 1));
    Real const by_s = 2 / s, by_ss = -0.5 * by_s * by_s;
    Real const by_d = (square_of_d - 1) * per_below - 2 * per_d;
    Real const by_dd = (1 + 4 * square_of_d - square_of_d * square_of_d) * per_below * per_below +
                       2 * per_d * per_d;
    Real const by_p = by_s + by_d, by_q = by_s - by_d;
    return {scale * by_p,
            scale * by_q,
            scale * (by_ss + by_dd + n * by_p * by_p),
            scale * (by_ss + by_dd + n * by_q * by_q),
            scale * (by_ss - by_dd + n * by_p * by_q),
            4 * scale};
}

}  // namespace harmorph
