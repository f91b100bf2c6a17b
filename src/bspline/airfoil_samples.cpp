#include "bspline/airfoil_samples.hpp"

namespace harmorph {
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
