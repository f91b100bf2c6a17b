// Slip boundaries: points stay on a straight line, or on a smooth curve, and slide along it.
#pragma once

#include "boundary/slip_along.hpp"

namespace harmorph {

// tangent [n_points]: unit vector along the line of a slipping point, (1, 0) elsewhere.
// Neighbouring faces that are parallel are one straight line; the tangent of all points there is
// from the first point of the line to the last. Faces that bend without a corner, or that have
// curves given, are one curve, which is added to `curves`. A point where two lines meet at a corner
// cannot slide and becomes fixed. Refused: as by SlipAlong::add().
Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions,
                       SlipAlong const& along, Span<PointKind> kinds, Span<Vec2> tangent,
                       SlipCurves& curves, Fault& fault) noexcept;

}  // namespace harmorph
