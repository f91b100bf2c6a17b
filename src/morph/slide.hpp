// Moved meshes whose sliding points are put back onto their curves, and the transpose of the
// derivative.
#pragma once

#include "boundary/slip_followers.hpp"

namespace harmorph {

struct Sliding {
    SlipCurves const& curves;
    SlipFollowers const& followers;
    Index n_points;

    // to = from, but sliding points at the nearest places of their curves, and followers moved
    // along. `to` may be `from`.
    void slide(Points from, MutablePoints to) const noexcept;
    // From derivatives by `to` to derivatives by `from`; both may be the same arrays.
    void transpose(Points from, Points derivative, MutablePoints to) const noexcept;
};

}  // namespace harmorph
