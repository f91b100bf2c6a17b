// The control points of a B-spline with given knots through points in order: weighted least squares
// in turn with corrections of the points' parameters. Hoschek, Comput. Aided Geom. Des. 5 (1988)
// 27; with tangent distances: Wang, Pottmann & Liu, ACM Trans. Graph. 25 (2006) 214.
#pragma once

#include "bspline/bspline.hpp"
#include "bspline/envelope_cholesky.hpp"

namespace harmorph {

struct LeastSquares {
    Curve curve;              // with the control points `control`
    Span<const Vec2> points;  // [n] in the order of the curve
    Span<Real> u;             // [n] their parameters, growing
    Span<Real> weight;        // [n]
    Span<Real> error;         // [n] out: their distances from the curve
    Span<Vec2> tangent;  // [n] out: unit tangents of the curve at their parameters; 0: not known
    Span<Real> control;  // [2 * n_control] out: x,y pairs
    Span<Index>
        pinned;  // [n_control] position of the point that a control point is fixed at, or none
    EnvelopeMatrix matrix;      // unknowns as in control
    Span<Real> largest_so_far;  // [n] work

    void lay_out(Arena& arena, Index n_points, Index n_control, Index degree) noexcept;
    void set_up(Curve const& shape,
                Span<const Vec2> through) noexcept;  // the arrays in the sizes of this problem
    void start() noexcept;                           // after new parameters: forgets the tangents
    // along: weight of errors along the curve relative to errors normal to it, 0 to 1. The
    // correction of the parameters removes errors along the curve anyway: with weight 1 the
    // iteration converges slowly; with 0, quadratically or not at all.
    void solve(Real along) noexcept;
    // Two Newton steps for the parameter of each point towards the nearest point of the curve; the
    // first and the last parameter stay, and the order is kept. Measures the errors between the two
    // steps; returns the largest.
    Real correct_parameters() noexcept;
};

}  // namespace harmorph
