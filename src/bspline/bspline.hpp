// bspline: B-spline curves; parameters of points on them; curves fitted to points.
//
// In: curves as views of the caller's arrays (degree, knots, control points, weights), or points in
// order. Out: basis functions and derivatives (bspline), nearest parameters and monotone parameters
// along a chain of points (projection), a fitted curve (fit, with knots, least_squares,
// envelope_cholesky; corners and curve_ends find corners, blunt bases and where a closed curve
// begins). For design: another airfoil on the knots of a curve (refit, with unit_points,
// point_spline, airfoil_line, airfoil_samples); the same curves with more control points
// (finer_curves); the outline of a body as a section with a chord, its measures and their
// derivatives by the control points (section, section_measures with section_area, section_stations,
// section_curvature, section_clearance; control_gradient, quadrature); design variables as maps to
// the control points (variables). Sources: Piegl & Tiller, below; least squares, knots and others
// in the files.
//
// This file: one curve, rational where there are weights: B-spline basis functions, points,
// derivatives. Piegl & Tiller, The NURBS Book, 2nd ed.: algorithm A2.1, equations 2.5 (basis), 2.7
// (derivatives), 4.8 (rational).
#pragma once

#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// A view: C(u) = sum_k N_k(u) P[indices[k]], u in [knots[degree], knots[n]], n = number of indices.
struct Curve {
    Index degree = 0;
    Index n_indices = 0;
    Index index_base = 0;
    Index n_control = 0;             // of the set that the curve belongs to
    const Index* indices = nullptr;  // [n_indices], or null: the control points in order
    const Real* knots = nullptr;     // [n_indices + degree + 1]
    const Real* control = nullptr;   // [2 * n_control] x,y pairs
    const Real* weights = nullptr;   // [n_control], or null

    Index control_point(Index k) const noexcept {
        return indices != nullptr ? indices[k] - index_base : k;
    }
    Vec2 point(Index k) const noexcept {
        return {control[2 * control_point(k)], control[2 * control_point(k) + 1]};
    }
    Real weight(Index k) const noexcept {
        return weights != nullptr ? weights[control_point(k)] : 1;
    }
    Real begin() const noexcept { return knots[degree]; }
    Real end() const noexcept { return knots[n_indices]; }
};

// The basis functions that are not 0 at one parameter: value[d][k] is the d-th derivative of that
// of control point control[k]. A control point that the curve repeats within one span appears
// twice; both values count.
struct CurveBasis {
    Index order = 0;  // degree + 1
    Index control[max_order] = {};
    Real value[max_order][max_order] = {};
};

// Checks degree, knots, indices, weights and control points; `number` is that of the curve in the
// fault (Fault::other).
Status check_curve(Curve const& curve, Index number, Fault& fault) noexcept;

// The i with knots[i] <= u < knots[i + 1]; at the end of the curve the last span that is not empty.
Index knot_span(Curve const& curve, Real u) noexcept;

// 0 <= n_derivatives <= max_degree; u outside the curve's range counts as the nearer end.
CurveBasis curve_basis(Curve const& curve, Real u, Index n_derivatives) noexcept;

// The polynomials of one span, which must not be empty: at a knot, the span selects the value from
// the left or the right.
CurveBasis curve_basis_in(Curve const& curve, Index span, Real u, Index n_derivatives) noexcept;

// C(u) and its derivatives: out [n_derivatives + 1].
void curve_point(Curve const& curve, Real u, Index n_derivatives, Vec2* out) noexcept;
void curve_point_in(Curve const& curve, Index span, Real u, Index n_derivatives,
                    Vec2* out) noexcept;

inline Vec2 curve_point(Curve const& curve, Real u) noexcept {
    Vec2 point;
    curve_point(curve, u, 0, &point);
    return point;
}

}  // namespace harmorph
