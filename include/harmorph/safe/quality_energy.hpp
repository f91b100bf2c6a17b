// How far a corner is from the shape and size of its target, as a power of the inverse quality: infinite at inversion.
#pragma once

#include "harmorph/safe/corner_map.hpp"

namespace harmorph {

// With J the map from the target corner, p and q as of CornerMap and d = det J > 0:
//     shape = |J|^2 / (2 d) = (p + q) / (p - q),   size = (d + 1/d) / 2,   energy = (shape^2 size)^power.
// Both are 1 at the target, turned and moved at will, and larger elsewhere. 1 / (shape sqrt(size)) is the size-skew
// quality relative to the target: P. M. Knupp, SIAM J. Sci. Comput. 23 (2001) 193, measures by the target matrix; 1 /
// size tends to 2 min(d, 1/d), but is smooth. So the energy is the quality to the power of -2 power.
class QualityEnergy {
public:
    // Of the smallest natural curvature; turning, which changes nothing at the target, has it too.
    static constexpr Real least_curvature = 0.02;

    explicit QualityEnergy(Triangle const& target) noexcept : map_(target) {}

    // Infinite where the corner has no positive area.
    Real energy(Triangle const& now, Index power) const noexcept;
    // Derivatives by the three points, see CornerMap, of `weight` times the energy. Curvatures below `least` times
    // 4 power energy, that of growing at the target, are raised to it.
    void differentiate(Triangle const& now, Index power, Real weight, Real least, Vec2 (&gradient)[3],
                       CornerMode (&mode)[4]) const noexcept;

private:
    CornerMap map_;
};

// x^n for n >= 1.
constexpr Real power_of(Real x, Index n) noexcept {
    Real product = x;
    for (Index k = 1; k < n; ++k) product *= x;
    return product;
}

}  // namespace harmorph
