// Slip boundaries: points stay on a straight line and slide along it.
#pragma once

#include "harmorph/boundary/conditions.hpp"

namespace harmorph {

// tangent [n_points]: unit vector along the line of a slipping point, (1, 0) elsewhere. Neighbouring faces that are parallel
// are one line, whose direction is that from its first point to its last, for all of its points. Where two lines meet at an
// angle, a point cannot slide: it becomes fixed. A boundary that bends little by little is no line, and is refused.
Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions, Span<PointKind> kinds,
                       Span<Vec2> tangent, Fault& fault) noexcept;

}  // namespace harmorph
