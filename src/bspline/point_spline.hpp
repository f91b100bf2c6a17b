// The cubic spline through points in order, with continuous second derivatives by the length of
// the polygon through the points. C. de Boor, A Practical Guide to Splines (1978), chapter IV.
#pragma once

#include "base/vec2.hpp"
#include "bspline/envelope_cholesky.hpp"

namespace harmorph {

class PointSpline {
public:
    void lay_out(Arena& arena, Index max_points) noexcept;
    // At least two points, each different from the next one. is_closed: the last point is the
    // first one again (at least four points), and the spline is smooth there; otherwise the second
    // derivative is constant in the first and in the last interval.
    void pass_through(Span<const Vec2> points, bool is_closed) noexcept;
    // The point at a share, 0 to 1, of the interval between two points.
    Vec2 at(Index interval, Real share) const noexcept;

private:
    Real step(Index k) const noexcept { return length(points_[k + 1] - points_[k]); }
    Vec2 second(Index k) const noexcept { return {second_[2 * k], second_[2 * k + 1]}; }

    Span<const Vec2> points_;
    Span<Real> second_;  // [2 * points] second derivatives, x,y pairs
    EnvelopeMatrix matrix_;
};

}  // namespace harmorph
