// The control points of a B-spline with given knots through points in order: weighted least squares, and the correction
// of the points' parameters that makes its residuals distances. Hoschek, Comput. Aided Geom. Des. 5 (1988) 27.
#pragma once

#include "harmorph/bspline.hpp"
#include "harmorph/envelope.hpp"

namespace harmorph {

struct LeastSquares {
    Curve curve;                // its control points are `control`
    Span<const Vec2> points;    // [n] in the order of the curve
    Span<Real> u;               // [n] their parameters, growing
    Span<Real> weight;          // [n]
    Span<Real> error;           // [n] out: their distances from the curve
    Span<Real> control;         // [2 * n_control] out: x,y pairs
    Span<Index> pinned;         // [n_control] position of the point that a control point is fixed at, or none
    EnvelopeMatrix matrix;
    Span<Real> right_x, right_y;  // [n_control]

    void lay_out(Arena& arena, Index n_points, Index n_control, Index degree) noexcept;
    void set_up(Curve const& shape, Span<const Vec2> through) noexcept;  // the arrays in the sizes of this problem
    void solve() noexcept;
    // Two Newton steps from each point's parameter towards its foot, each at most half way to its neighbours; the first and
    // the last stay. Measures the error in between; returns the largest.
    Real correct_parameters() noexcept;
};

}  // namespace harmorph
