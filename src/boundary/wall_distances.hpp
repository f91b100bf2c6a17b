// Checks that the points of a wall lie on their curves.
#pragma once

#include "boundary/moving_boundary.hpp"

namespace harmorph {

// Refuses a point whose distance from its curve is at least max_distance, as a fraction of the
// diagonal of the box around the curve, or larger than the extent of the curve or of the wall; and
// a point that lies on another curve, which no condition names together with its curve. Warns
// (Status::far_from_curve) of a point that is at least 0.001 of the diagonal away, or that lies
// beyond the end of its curve, where all points have the same displacement.
Status check_distances(Points points, Span<const Condition> conditions, Span<const Curve> curves,
                       Real max_distance, Wall const& wall, Fault& fault) noexcept;

}  // namespace harmorph
