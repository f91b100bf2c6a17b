// Finds the positions of the three points of a corner.
#pragma once

#include "safe/corner_map.hpp"
#include "safe/region.hpp"

namespace harmorph {

inline Triangle triangle_of(CornerPoints const& point, Points at) noexcept {
    return {{turned_start(at[point[0]], at[point[1]], point.turn), at[point[1]], at[point[2]]}};
}

}  // namespace harmorph
