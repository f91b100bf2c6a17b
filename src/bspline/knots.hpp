// Places the knots of a fit. Knots are dense where the outline is curved, and in later rounds where
// the error of the fit is large, but never closer than the points.
#pragma once

#include "bspline/bspline.hpp"

namespace harmorph {

// The points in the order of the curve are its positions 0 .. n - 1; on a closed curve, the last
// position is the first point again.
struct KnotSites {
    Span<const Real> u;         // [n] parameters of the points, growing from 0 to 1
    Span<Real> mass;            // [n - 1] integral of the wanted knot density over each interval
    Span<Real> capped;          // [n - 1] working space
    Span<const Index> corner;   // ascending positions that get a knot of multiplicity `degree`
    Span<Index> section_spans;  // [corners + 1] output: the number of knot spans between corners
};

// Sets the mass by arc length with the density 1 + 8 sqrt(curvature); lengths are in units of the
// extent of the body.
void weigh_by_curvature(Span<const Real> arc, Span<const Real> curvature, Span<Real> mass) noexcept;

// Moves mass to where the errors are. The error of a spline is proportional to the width of a span
// to the power degree + 1, so the mass is multiplied by that root of the error, which distributes
// the error evenly (de Boor, A Practical Guide to Splines, ch. XII). With a pace from 0 to 1, this
// part of the change is made. error [n] are the errors of
// the points at their fitted parameters u [n]; span_error [curve.n_indices] is working space.
void weigh_by_error(Curve const& curve, Span<const Real> u, Span<const Real> error,
                    KnotSites const& sites, Real pace, Span<Real> span_error) noexcept;

// Returns the number of corners that can have a knot of multiplicity `degree`, with a span on
// either side.
Index corners_possible(Index degree, Index n_indices) noexcept;

// Writes knots [n_indices + degree + 1], which are clamped at 0 and 1, or periodic with period 1. A
// periodic curve must have no corners.
void place_knots(KnotSites const& sites, Index degree, Index n_indices, bool periodic,
                 Span<Real> knots) noexcept;

}  // namespace harmorph
