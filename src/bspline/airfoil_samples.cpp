#include "bspline/airfoil_samples.hpp"

namespace harmorph {

namespace {

// Between samples of a smooth leading edge the direction changes by less than 37 degrees.
constexpr Real min_cosine = 0.8;

}  // namespace

void AirfoilLine::lay_out(Arena& arena, Index max_points) noexcept {
    arena.take(at, max_points);
    arena.take(share, max_points);
}

// Between the farthest sample and its neighbours the line is a parabola, so that the leading edge
// moves smoothly with the line; a sharp leading edge is the sample itself.
Real AirfoilLine::find_leading_edge(Index farthest) noexcept {
    leading = at[farthest];
    if (farthest == 0 || farthest == n - 1) return share[farthest];
    Real const before = share[farthest - 1] - share[farthest],
               after = share[farthest + 1] - share[farthest];
    // Samples of a curve that stands still are at one place.
    if (!(before < 0 && after > 0)) return share[farthest];
    Vec2 const back = (1 / before) * (at[farthest - 1] - leading),
               ahead = (1 / after) * (at[farthest + 1] - leading);
    if (dot(back, ahead) < min_cosine) return share[farthest];
    // The second divided differences of the line and of the square of the distance.
    Vec2 const bend = (1 / (after - before)) * (ahead - back);
    Real const distance = square(leading - trailing),
               towards_back = (square(at[farthest - 1] - trailing) - distance) / before,
               towards_ahead = (square(at[farthest + 1] - trailing) - distance) / after,
               curvature = (towards_ahead - towards_back) / (after - before);
    if (!(curvature < 0)) return share[farthest];
    Real const top =
        clamp((before * curvature - towards_back) / (2 * curvature), 0.5 * before, 0.5 * after);
    leading = leading + top * (back + (top - before) * bend);
    return share[farthest] + top;
}

bool AirfoilLine::measure() noexcept {
    trailing = 0.5 * (at[0] + at[n - 1]);
    Index farthest = 0;
    share[0] = 0;
    for (Index k = 1; k < n; ++k) {
        share[k] = share[k - 1] + length(at[k] - at[k - 1]);
        if (square(at[k] - trailing) > square(at[farthest] - trailing)) farthest = k;
    }
    Real const first_side = find_leading_edge(farthest), second_side = share[n - 1] - first_side;
    if (!(first_side > 0 && second_side > 0)) return false;
    for (Index k = 0; k < n; ++k) {
        share[k] = share[k] <= first_side ? share[k] / first_side
                                          : 1 + (share[k] - first_side) / second_side;
    }
    return true;
}

bool AirfoilLine::runs_clockwise() const noexcept {
    Real area = 0;
    for (Index k = 1; k < n; ++k) area += cross(at[k - 1] - at[0], at[k] - at[0]);
    return area < 0;
}

Index AirfoilLine::interval_of(Real wanted, Real& position) const noexcept {
    Index low = 0, high = n - 1;
    while (high - low > 1) {
        Index const middle = low + (high - low) / 2;
        (share[middle] <= wanted ? low : high) = middle;
    }
    Real const width = share[high] - share[low];
    position = width > 0 ? clamp((wanted - share[low]) / width, 0.0, 1.0) : 0;
    return low;
}

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

namespace {

constexpr Index max_per_interval = 64;

}  // namespace

void AirfoilSamples::lay_out(Arena& arena, Index n_points, Index min_samples) noexcept {
    Index const wanted = (min_samples + n_points - 1) / n_points;
    per_interval_ = clamp(wanted, Index(1), max_per_interval);
    arena.take(corner_, n_points);
    arena.take(along_, Offset{n_points} + 1);
    points.lay_out(arena, n_points);
    outline_.lay_out(arena, n_points);
    spline_.lay_out(arena, n_points + 1);
    max_samples_ = n_points * per_interval_ + 1;
    line.lay_out(arena, max_samples_);
}

Status AirfoilSamples::take(Points given, Index n, bool is_loop, Fault& fault) noexcept {
    HARMORPH_TRY(points.take(given, n, is_loop, fault));
    outline_.points = points.at;
    outline_.is_loop = is_loop;
    outline_.measure();
    n_corners = drop_facets(outline_, corner_, find_corners(outline_, corner_));
    course = choose_course(outline_, corner_.first(n_corners), Closure::automatic);
    n_corners = corners_on(course, outline_, corner_.first(n_corners), n);
    gather(n);
    sample();
    if (line.measure()) return Status::ok;
    return fault.refuse(Status::bad_curve, "the points are not the outline of an airfoil");
}

void AirfoilSamples::gather(Index n) noexcept {
    for (Index k = 0; k < course.n_positions; ++k)
        along_[k] = points.at[static_cast<Index>((Offset{course.first} + k) % n)];
}

// Each sequence of points between two corners has one spline.
void AirfoilSamples::sample() noexcept {
    Index const last = course.n_positions - 1;
    line.n = 0;
    for (Index run = 0, first = 0; run <= n_corners; ++run) {
        Index const end = run < n_corners ? corner_[run] : last;
        bool const is_smooth_loop = course.closure == Closure::periodic && last >= 3;
        spline_.pass_through(along_.from(first, end - first + 1), is_smooth_loop);
        for (Index k = first; k < end; ++k) {
            for (Index j = 0; j < per_interval_; ++j)
                line.add(spline_.at(k - first, static_cast<Real>(j) / per_interval_));
        }
        first = end;
    }
    line.add(along_[last]);
}

void AirfoilSamples::begin_at_farthest(Vec2 direction) noexcept {
    if (!course.closes()) return;
    Index const step = course.closure == Closure::tied ? per_interval_ : 1;
    Index best = 0, next_corner = 0;
    for (Index k = 0; k < line.n; k += step) {
        if (course.closure == Closure::tied && k > 0) {
            if (next_corner == n_corners || corner_[next_corner] * per_interval_ != k) continue;
            ++next_corner;
        }
        if (dot(line.at[k] - line.at[best], direction) > 0) best = k;
    }
    if (best == 0) return;
    line.begin_at(best);
    line.measure();
}

}  // namespace harmorph
