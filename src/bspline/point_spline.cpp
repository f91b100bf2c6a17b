#include "bspline/point_spline.hpp"

namespace harmorph {

void PointSpline::lay_out(Arena& arena, Index max_points) noexcept {
    arena.take(second_, 2 * static_cast<Offset>(max_points));
    matrix_.lay_out(arena, max_points, 1, true);
}

// Unknown k is the second derivative at point k if the spline is closed, and at point k + 1 if it
// is open.
void PointSpline::pass_through(Span<const Vec2> points, bool is_closed) noexcept {
    points_ = points;
    Index const last = points.count() - 1;
    Index const n = is_closed ? last : last - 1;
    fill(second_, Real(0));
    if (n < 1) return;
    matrix_.shape(n, 1, true);
    Span<Real> const right{second_.data() + (is_closed ? 0 : 2), static_cast<Size>(2 * n)};
    for (Index k = 0; k < n; ++k) {
        Index const point = is_closed ? k : k + 1;
        Index const before = point == 0 ? last - 1 : point - 1;
        Real const h = step(before), next_h = step(point);
        matrix_.add(k, k, 2 * (h + next_h));
        if (is_closed) {
            matrix_.add(k, k + 1 == n ? 0 : k + 1, next_h);
        } else {
            if (k + 1 < n) matrix_.add(k, k + 1, next_h);
            matrix_.add(k, k, (k == 0 ? h : 0) + (k + 1 == n ? next_h : 0));
        }
        Vec2 const bend = (6 / next_h) * (points[point + 1] - points[point]) -
                          (6 / h) * (points[point] - points[before]);
        right[2 * k] = bend.x;
        right[2 * k + 1] = bend.y;
    }
    matrix_.factor();
    matrix_.solve(right, 2);
    for (Index c = 0; c < 2; ++c) {
        if (!is_closed) second_[c] = second_[2 + c];
        second_[2 * last + c] = is_closed ? second_[c] : second_[2 * last - 2 + c];
    }
}

Vec2 PointSpline::at(Index interval, Real share) const noexcept {
    Real const t = share, s = 1 - share, h = step(interval);
    Real const factor = h * h / 6;
    return s * points_[interval] + t * points_[interval + 1] +
           factor * (s * s * s - s) * second(interval) +
           factor * (t * t * t - t) * second(interval + 1);
}

}  // namespace harmorph
