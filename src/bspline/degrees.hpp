// Computes turns by angles in degrees.
#pragma once

#include "base/angle.hpp"

namespace harmorph {

inline constexpr Real per_degree = pi / 180;

// Returns the turn by an angle of at most a million degrees. Multiples of 90 degrees are exact.
inline Vec2 turn_by(Real degrees) noexcept {
    Index const right_angles = static_cast<Index>(degrees / 90 + (degrees < 0 ? -0.5 : 0.5));
    Real const a = (degrees - 90.0 * right_angles) * per_degree, s = a * a;  // |a| <= pi / 4
    Real sine = 1, cosine = 1;
    for (Index k = 10; k >= 1; --k) {
        cosine = 1 - s / ((2 * k - 1) * (2 * k)) * cosine;
        sine = 1 - s / ((2 * k) * (2 * k + 1)) * sine;
    }
    Vec2 turn{cosine, a * sine};
    for (Index k = 0; k < ((right_angles % 4) + 4) % 4; ++k) turn = left_of(turn);
    return turn;
}

}  // namespace harmorph
