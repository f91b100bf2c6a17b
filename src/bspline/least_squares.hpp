// Computes the control points of a B-spline with given knots through points in order. Weighted
// least squares alternate with corrections of the points' parameters: Hoschek, Comput. Aided Geom.
// Des. 5 (1988) 27; with tangent distances: Wang, Pottmann & Liu, ACM Trans. Graph. 25 (2006) 214.
#pragma once

#include "bspline/bspline.hpp"
#include "bspline/envelope_cholesky.hpp"

namespace harmorph {

struct LeastSquares {
    Curve curve;              // with the control points `control`
    Span<const Vec2> points;  // [n] in the order of the curve
    Span<Real> u;             // [n] the growing parameters of the points
    Span<Real> weight;        // [n]
    Span<Real> error;         // [n] output: the distances of the points from the curve
    // [n] Output: unit tangents of the curve at the parameters; 0 if they are not known.
    Span<Vec2> tangent;
    Span<Real> control;  // [2 * n_control] output: pairs x, y
    // [n_control] The position of the point at which a control point is pinned, or none.
    Span<Index> pinned;
    // The weight of the integral of |C''|^2 by the parameter, which is added to the sum of squares.
    Real bending = 0;
    // Unit tangents at the first and the last end of the curve, or 0. If a tangent does not suit
    // the points, the least squares alone would shorten the derivative of the curve there to 0, or
    // reverse the derivative. Therefore the derivative is at least a third of `speed`, the speed of
    // the points by their parameters.
    Vec2 direction[2];
    Real speed = 1;
    bool has_min_speed[2] = {};  // set by solve()
    EnvelopeMatrix matrix;       // the unknowns have the order of `control`
    Span<Real> largest_so_far;   // [n] working space

    void lay_out(Arena& arena, Offset n_points, Index n_control, Index degree) noexcept;
    // Sets the curve and the points, and gives the arrays the sizes of this problem.
    void set_up(Curve const& shape, Span<const Vec2> through) noexcept;
    // Must be called after the parameters have been changed: sets the tangents to 0.
    void start() noexcept;
    // `along` from 0 to 1 is the weight of errors along the curve relative to errors normal to it.
    // The correction of the parameters removes errors along the curve anyway. With weight 1 the
    // iteration converges slowly; with weight 0 it converges quadratically or not at all.
    void solve(Real along) noexcept;
    // Makes two Newton steps for the parameter of each point towards the nearest point of the
    // curve. The first and the last parameter and the order do not change. The errors are those
    // between the two steps; returns the largest one.
    Real correct_parameters() noexcept;

private:
    void solve_once(Real along) noexcept;
};

}  // namespace harmorph
