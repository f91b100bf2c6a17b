// The room bspline evaluates B-spline curves, finds the parameters of points on them, fits curves
// to points, and measures sections. README.md in this folder describes the files.
//
// Here one curve is evaluated: B-spline basis functions, points and derivatives. The curve is
// rational if it has weights. The source is Piegl & Tiller, The NURBS Book, 2nd ed.: algorithm A2.1
// and equations 2.5 (basis), 2.7 (derivatives) and 4.8 (rational).
#pragma once

#include "base/span.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// A view of the curve C(u) = sum_k N_k(u) P[indices[k]] for u in [knots[degree], knots[n]], where n
// is the number of indices.
struct Curve {
    Index degree = 0;
    Index n_indices = 0;
    Index index_base = 0;
    Index n_control = 0;             // all control points, which several curves may share
    const Index* indices = nullptr;  // [n_indices], or null for the control points in order
    const Real* knots = nullptr;     // [n_indices + degree + 1]
    const Real* control = nullptr;   // [2 * n_control] pairs x, y
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

// The basis functions that are not 0 at one parameter: value[d][k] is the d-th derivative of the
// function of control point control[k]. If the curve repeats a control point within one span, the
// control point appears twice, and both values count.
struct CurveBasis {
    Index order = 0;  // degree + 1
    Index control[max_order] = {};
    Real value[max_order][max_order] = {};
};

// Checks degree, knots, indices, weights and control points; `number` is the number of the curve in
// the fault.
Status check_curve(Curve const& curve, Index number, Fault& fault) noexcept;

// Returns the span i with knots[i] <= u < knots[i + 1]; at the end of the curve, the last span that
// is not empty.
Index knot_span(Curve const& curve, Real u) noexcept;

// Evaluates the basis functions at u with 0 <= n_derivatives <= max_degree. A parameter outside the
// range of the curve counts as the nearer end.
CurveBasis curve_basis(Curve const& curve, Real u, Index n_derivatives) noexcept;

// Evaluates the polynomials of one span, which must not be empty. At a knot, the span selects the
// value from the left or from the right.
CurveBasis curve_basis_in(Curve const& curve, Index span, Real u, Index n_derivatives) noexcept;

// Writes C(u) and its derivatives to out [n_derivatives + 1].
void curve_point(Curve const& curve, Real u, Index n_derivatives, Vec2* out) noexcept;
void curve_point_in(Curve const& curve, Index span, Real u, Index n_derivatives,
                    Vec2* out) noexcept;

inline Vec2 curve_point(Curve const& curve, Real u) noexcept {
    Vec2 point;
    curve_point(curve, u, 0, &point);
    return point;
}

}  // namespace harmorph
