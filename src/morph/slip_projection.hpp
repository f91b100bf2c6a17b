// Moves the slipping points of a moved mesh back onto their curves; the derivative, and its
// transpose. tests/morph/test_slip.cpp covers this file.
#pragma once

#include "boundary/slip_followers.hpp"

namespace harmorph {

struct SlipProjection {
    SlipCurves const& curves;
    SlipFollowers const& followers;
    Index n_points;

    // Copies `from` to `to`, with slipping points at the nearest places of their curves, and
    // followers moved along. `to` may be `from`.
    void project(Points from, MutablePoints to) const noexcept;
    // Converts a velocity of the points of `from` into that of the points of `to`; both may be the
    // same arrays.
    void differentiate(Points from, Points velocity, MutablePoints to) const noexcept;
    // Converts derivatives by `to` into derivatives by `from`; both may be the same arrays.
    void transpose(Points from, Points derivative, MutablePoints to) const noexcept;
};

}  // namespace harmorph
