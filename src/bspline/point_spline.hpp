// Interpolates points in order by a cubic spline with continuous second derivatives; the parameter
// is the length of the polygon through the points. C. de Boor, A Practical Guide to Splines (1978),
// chapter IV.
#pragma once

#include "base/vec2.hpp"
#include "bspline/envelope_cholesky.hpp"

namespace harmorph {

class PointSpline {
public:
    void lay_out(Arena& arena, Index max_points) noexcept;
    // There must be at least two points, each different from the next one. If is_closed is true,
    // there must be at least four points, the last point must be the first one again, and the
    // spline is smooth there. Otherwise the second derivative is constant in the first and in the
    // last interval.
    void pass_through(Span<const Vec2> points, bool is_closed) noexcept;
    // Returns the point at a share, from 0 to 1, of the interval between two points.
    Vec2 at(Index interval, Real share) const noexcept;

private:
    Real step(Index k) const noexcept { return length(points_[k + 1] - points_[k]); }
    Vec2 second(Index k) const noexcept { return {second_[2 * k], second_[2 * k + 1]}; }

    Span<const Vec2> points_;
    Span<Real> second_;  // [2 * points] second derivatives, pairs x, y
    EnvelopeMatrix matrix_;
};

}  // namespace harmorph
