// Whether the points of a wall lie on the curves that they were given.
#pragma once

#include "boundary/moving_boundary.hpp"

namespace harmorph {

// Refused: a point that is farther from its curve than curve or wall is large, and a point that
// lies on another curve, which no condition names together with its own. Status::far_from_curve: a
// point that is .05 of that extent away, or that lies beyond the end of its curve, where several
// points would move as one.
Status check_distances(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                       Wall const& wall, Fault& fault) noexcept;

}  // namespace harmorph
