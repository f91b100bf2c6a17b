// How far a corner is from the shape and size of its target, as a power of the inverse quality: infinite at inversion.
#pragma once

#include "harmorph/safe/corner_map.hpp"

namespace harmorph {

// With J the map from the target corner, p and q as of CornerMap and d = det J > 0:
//     shape = |J|^2 / (2 d) = (p + q) / (p - q),   size = (d + 1/d) / 2,   energy = (scale shape^2 size)^power.
// Both are 1 at the target, turned and moved at will, and larger elsewhere. 1 / (shape sqrt(size)) is the size-skew
// quality relative to the target: P. M. Knupp, SIAM J. Sci. Comput. 23 (2001) 193, measures by the target matrix; 1 /
// size tends to 2 min(d, 1/d), but is smooth. So with scale = least^2 the energy is (least / quality)^(2 power).
class QualityEnergy {
public:
    // Of the smallest natural curvature; turning, which changes nothing at the target, has it too.
    static constexpr Real least_curvature = 0.02;

    explicit QualityEnergy(Triangle const& target, Index power = 1, Real scale = 1) noexcept
        : map_(target), power_(power), scale_(scale) {}

    // Infinite where the corner has no positive area, or is so far from its target that a derivative would overflow.
    Real energy(Triangle const& now) const noexcept;
    // Derivatives by the three points, see CornerMap, of `weight` times the energy, which is finite. Curvatures below
    // `least` times 4 power energy, that of growing at the target, are raised to it.
    void differentiate(Triangle const& now, Real weight, Real least, Vec2 (&gradient)[3],
                       CornerMode (&mode)[4]) const noexcept;

private:
    CornerMap map_;
    Index power_;
    Real scale_;
};

}  // namespace harmorph
