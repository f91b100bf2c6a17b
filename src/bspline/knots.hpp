// The knots of a fit: dense where the outline is curved, then where the error of the fit is large,
// never closer than the points.
#pragma once

#include "bspline/bspline.hpp"

namespace harmorph {

// Points in the order of the curve are its positions 0 .. n - 1; of a closed curve the last is the
// first once more.
struct KnotSites {
    Span<const Real> u;  // [n] parameters of the points, growing from 0 to 1
    Span<Real> mass;  // [n - 1] integral of the wanted knot density over each interval, in any unit
    Span<Real> capped;          // [n - 1] work
    Span<const Index> corner;   // positions, ascending, that get a knot of multiplicity `degree`
    Span<Index> section_spans;  // [corners + 1] out: knot spans between corners
};

// Mass by arc length with density 1 + 8 sqrt(curvature), lengths in units of the body's extent.
void weigh_by_curvature(Span<const Real> arc, Span<const Real> curvature, Span<Real> mass) noexcept;

// Moves mass to where the errors are: the error of a spline is proportional to the width of a span
// to the power degree
// + 1, so mass is multiplied by that root of the error, which equidistributes the error (de Boor, A
// Practical Guide to Splines, ch. XII). error [n] of the points at their fitted parameters u [n];
// span_error [curve.n_indices] is work.
void weigh_by_error(Curve const& curve, Span<const Real> u, Span<const Real> error,
                    KnotSites const& sites, Span<Real> span_error) noexcept;

// How many corners can have a knot of multiplicity `degree`, with a span on either side.
Index corners_possible(Index degree, Index n_indices) noexcept;

// Clamped at 0 and 1, or periodic with period 1 (then without corners): knots [n_indices + degree +
// 1].
void place_knots(KnotSites const& sites, Index degree, Index n_indices, bool periodic,
                 Span<Real> knots) noexcept;

}  // namespace harmorph
