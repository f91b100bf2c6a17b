// Slip boundaries: points stay on a straight line and slide along it.
#pragma once

#include "harmorph/boundary/conditions.hpp"

namespace harmorph {

// tangent [n_points]: unit vector along the line of a slipping point, (1, 0) elsewhere. Neighbouring faces that are
// parallel are one straight line; the tangent of all points there is from the first point of the line to the last. A
// point where two lines meet at an angle cannot slide and becomes fixed. A curved boundary is refused.
Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions, Span<PointKind> kinds,
                       Span<Vec2> tangent, Fault& fault) noexcept;

}  // namespace harmorph
