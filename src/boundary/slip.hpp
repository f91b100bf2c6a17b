// Finds the lines of slip boundaries: points stay on a straight line or on a smooth curve, and
// slip along the line or curve.
#pragma once

#include "boundary/slip_along.hpp"

namespace harmorph {

// Writes the unit vector along the line of each slipping point to tangent [n_points], and (1, 0)
// for other points. Neighbouring faces that are parallel are one straight line, and all its points
// have the tangent from the first point of the line to the last. Faces that bend without a corner,
// or for which curves are given, are one curve, which is added to `curves`. A point where two lines
// meet at a corner cannot slip and becomes fixed. Refuses the same lines as SlipAlong::add().
Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions,
                       SlipAlong const& along, Span<PointKind> kinds, Span<Vec2> tangent,
                       SlipCurves& curves, Fault& fault) noexcept;

}  // namespace harmorph
