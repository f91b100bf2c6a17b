// Measures the deviation of a triangle from the shape and the size of a reference by an energy that
// stays finite when the triangle is folded. V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais,
// N. Ray, D. Sokolov: Foldover-free maps in 50 lines of code, ACM Trans. Graph. 40 (2021), eqs.
// 2-4.
#pragma once

#include "safe/corner_map.hpp"

namespace harmorph {

// Returns a number that is positive for every determinant, increases with the determinant, and is
// close to a large one. With softness 0 it is the positive part.
inline Real regularised(Real determinant, Real softness) noexcept {
    Real const root = sqrt(softness * softness + determinant * determinant);
    if (determinant <= 0 && softness == 0) return 0;
    return determinant > 0 ? 0.5 * (determinant + root)
                           : 0.5 * softness * softness / (root - determinant);
}

// The energy of the map J from the reference, with the regularised determinant chi: (|J|^2 +
// size_weight (det^2 + 1)) / chi.
struct Distortion {
    static constexpr Real size_weight = 0.1;

    explicit Distortion(Triangle const& reference) noexcept : map_(reference) {}

    Real determinant(Triangle const& now) const noexcept { return map_.determinant(now); }
    Real energy(Triangle const& now, Real softness) const noexcept;
    // Returns the derivatives of the energy. Their unit is the curvature of |J|^2 / chi, so that
    // with least >= 0 no curvature is negative; see CornerMap.
    DensityDerivatives derivatives(Triangle const& now, Real softness) const noexcept;
    // Adds the derivatives by the sides to `form`; see CornerMap.
    void differentiate(Triangle const& now, Real softness, Real min_curvature,
                       CornerForm& form) const noexcept {
        map_.differentiate(now, derivatives(now, softness), min_curvature, form);
    }
    CornerMap const& map() const noexcept { return map_; }

private:
    CornerMap map_;
};

}  // namespace harmorph
