// Measures the deviation of corners from the shape and the size of their targets by a power of the
// inverse quality, which is infinite for inverted corners; many corners at a time.
#pragma once

#include "safe/corner_form.hpp"
#include "safe/corner_triangle.hpp"
#include "simd/cpu.hpp"

namespace harmorph {

// Corners, their targets, and the energy of each. With the linear map J from the target to the
// corner (p and q as in CornerMap) and d = det J > 0:
//   shape = |J|^2 / (2 d) = (p + q) / (p - q),   size = (d + 1/d) / 2,
//   energy = weight (scale shape^2 size)^power.
// Shape and size are 1 at the target, which may be turned and moved, and larger elsewhere. The
// inverse 1 / (shape sqrt(size)) is the size-skew quality relative to the target: P. M. Knupp, SIAM
// J. Sci. Comput. 23 (2001) 193, measures quality by the target matrix; 1 / size tends to 2 min(d,
// 1/d) but is smooth. So with scale = least^2 the energy is weight (least / quality)^(2 power).
struct CornerList {
    static constexpr Index max_count = 32;

    Index n = 0, power = 1;
    // The x and y of the two sides, of the corner and of the target.
    Real now[4][max_count], target[4][max_count];
    // Not 0: the target has sides in the ratio of those of the corner. The area of the target
    // stays, and |J|^2 is the smallest for all ratios; therefore its derivatives need no term for
    // the dependence of the target on the corner.
    Real any_ratio[max_count];
    Real weight[max_count], scale[max_count];

    void add(Triangle const& corner, Triangle const& wanted, bool has_any_ratio, Real weight_of_one,
             Real scale_of_one) noexcept {
        put(now, corner);
        put(target, wanted);
        any_ratio[n] = has_any_ratio ? 1 : 0;
        weight[n] = weight_of_one;
        scale[n++] = scale_of_one;
    }

private:
    void put(Real (&to)[4][max_count], Triangle const& triangle) const noexcept {
        Vec2 const side = triangle.at[1] - triangle.at[0], next = triangle.at[2] - triangle.at[1];
        Real const value[] = {side.x, side.y, next.x, next.y};
        for (Index k = 0; k < 4; ++k) to[k][n] = value[k];
    }
};

// The members of CornerForm, corner by corner.
struct CornerForms {
    static constexpr Index count = 14;
    Real value[count][CornerList::max_count];

    // Adds the derivatives of corner k.
    void add_to(CornerForm& form, Index k) const noexcept {
        auto const at = [&](Index i) { return value[i][k]; };
        form.by_side = form.by_side + Vec2{at(0), at(1)};
        form.by_next = form.by_next + Vec2{at(2), at(3)};
        form.side_side = form.side_side + Block{at(4), at(5), at(5), at(6)};
        form.next_next = form.next_next + Block{at(7), at(8), at(8), at(9)};
        form.side_next = form.side_next + Block{at(10), at(11), at(12), at(13)};
    }
};

struct QualityKernels {
    // Finds the energy of each corner: infinity if the corner has no positive area, or is so far
    // from its target that a derivative would overflow. Returns the sum.
    Real (*energies)(CornerList& list, Real* energy) noexcept;
    // Finds the derivatives by the sides of the corners, the energies of which must be finite.
    // Curvatures are raised to `min_curvature` times 4 power energy, the curvature of scaling at
    // the target.
    void (*differentiate)(CornerList& list, Real min_curvature, CornerForms& forms) noexcept;
};

// Returns the kernels of this set; automatic: those of the baseline. The results have the same bits
// in all sets.
QualityKernels const& quality_kernels(Kernel kernel) noexcept;

}  // namespace harmorph
