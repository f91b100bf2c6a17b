// Keeps a fitted curve near the polygon of the points. Between points that are far apart at a round
// nose, least squares alone let the curve bulge. Where the curve leaves the polygon too far, points
// are inserted: the curve's own points, drawn towards the polygon, and the fit is repeated.
// tests/bspline/test_fit.cpp covers this file.
#include "bspline/fit.hpp"

namespace harmorph {
namespace {

constexpr Index departure_samples = 32;
constexpr Index rounds_of_knots = 4;  // in each round of insertion
// Inserted points are at most `near_polygon` from the polygon in the first round, and nearer by
// this part of `near_polygon` in each later round, because the curve passes them by.
constexpr Index insertion_rounds = 5;
constexpr Real nearer_by = 0.15;
constexpr Real near_polygon = 1.7e-3;  // [extent] the largest departure from the polygon
constexpr Real tolerable_error =
    3e-4;  // [extent] an error of the points that is as bad as `near_polygon`
// [radians] Where the polygon turns less from side to side, the points resolve the shape, and the
// curve may leave the polygon by the sagitta of an arc with this turn.
constexpr Real resolved_turn = 0.52, sagitta_margin = 1.5;

Real departure_from(Vec2 p, Vec2 a, Vec2 b, Vec2& foot) noexcept {
    Vec2 const along = b - a;
    Real const squared = square(along);
    Real const share = squared > 0 ? clamp(dot(p - a, along) / squared, Real(0), Real(1)) : 0;
    foot = a + share * along;
    return length(p - foot);
}

}  // namespace

Curve Fit::unit_curve() const noexcept {
    Curve shape = squares_.curve;
    shape.control = control.data();
    return shape;
}

Vec2 Fit::vertex(Index position) const noexcept {
    Index const last = course_.n_positions - 1;
    if (!course_.closes()) return along_[clamp(position, Index(0), last)];
    return along_[(position % last + last) % last];
}

// 2 sin(angle / 2) of the change of direction of the polygon at a position.
Real Fit::turn_at(Index position) const noexcept {
    Vec2 const in = vertex(position) - vertex(position - 1);
    Vec2 const out = vertex(position + 1) - vertex(position);
    if (square(in) == 0 || square(out) == 0) return 0;
    return length((1 / length(out)) * out - (1 / length(in)) * in);
}

// Only the segments beside this part of the curve count: where the section is thin, its other side
// is no measure of this one.
Real Fit::departure_after(Index position) const noexcept {
    Curve const shape = unit_curve();
    Real largest = 0;
    for (Index sample = 0; sample < departure_samples; ++sample) {
        Real const share = (sample + 0.5) / departure_samples;
        Vec2 const place =
            curve_point(shape, (1 - share) * best_u_[position] + share * best_u_[position + 1]);
        Real nearest = infinity;
        for (Index k = position - 1; k <= position + 1; ++k) {
            Vec2 foot;
            nearest = min(nearest, departure_from(place, vertex(k), vertex(k + 1), foot));
        }
        largest = max(largest, nearest);
    }
    return largest;
}

void Fit::report_departure(FitReport& report) const noexcept {
    report.max_departure = 0;
    for (Index k = 0; k + 1 < course_.n_positions; ++k) {
        Real const departure = points_.extent * departure_after(k);
        if (report.departure_point != none && departure <= report.max_departure) continue;
        report.max_departure = departure;
        report.departure_point = point_at(k);
    }
}

Real Fit::error_at_points() const noexcept {
    Curve const shape = unit_curve();
    Real largest = 0;
    for (Index k = 0; k < course_.n_positions; ++k)
        largest = max(largest, length(curve_point(shape, best_u_[k]) - along_[k]));
    return largest;
}

// Marks the intervals in which the curve departs too far; marks of earlier insertion_rounds stay.
// Returns the largest departure, or 0 if no interval departs too far.
Real Fit::mark_departures() noexcept {
    Real worst = 0;
    for (Index k = 0; k + 1 < course_.n_positions; ++k) {
        Real const turn = max(turn_at(k), turn_at(k + 1));
        Real const step = length(vertex(k + 1) - vertex(k));
        Real const allowed = turn < resolved_turn
                                 ? max(near_polygon, sagitta_margin * step * turn / 8)
                                 : near_polygon;
        Real const departure = departure_after(k);
        if (departure <= allowed) continue;
        worst = max(worst, departure);
        marked_[k] = 1;
    }
    return worst;
}

// Moves the points apart, from the last one on, and puts points of the curve between them, at most
// `farthest` from the polygon. Returns the number of all points along the curve.
Index Fit::insert_points(Real farthest) noexcept {
    Curve const shape = unit_curve();
    Index const last = course_.n_positions - 1;
    place_[0] = 0;
    for (Index k = 0; k < last; ++k)
        place_[k + 1] = place_[k] + 1 + (marked_[k] != 0 ? inserted_points : 0);
    Vec2 next = along_[last];
    Real next_u = best_u_[last], next_curvature = curvature_[last];
    for (Index k = last; k >= 0; --k) {
        Vec2 const here = along_[k];
        Real const u = best_u_[k], curvature = curvature_[k];
        for (Index i = 1; k < last && marked_[k] != 0 && i <= inserted_points; ++i) {
            Real const share = static_cast<Real>(i) / (inserted_points + 1);
            Vec2 const place = curve_point(shape, (1 - share) * u + share * next_u);
            Vec2 foot;
            Real const departure = departure_from(place, here, next, foot);
            Index const at = place_[k] + i;
            along_[at] = foot + (departure > farthest ? farthest / departure : 1) * (place - foot);
            curvature_[at] = (1 - share) * curvature + share * next_curvature;
        }
        along_[place_[k]] = here;
        curvature_[place_[k]] = curvature;
        next = here;
        next_u = u;
        next_curvature = curvature;
    }
    return place_[last] + 1;
}

Index Fit::position_at(Index place) const noexcept {
    Index k = 0;
    while (k + 1 < course_.n_positions && place_[k] < place) ++k;
    return k;
}

// Leaves the points of the caller along the curve, with the parameters that the fit found.
void Fit::remove_inserted(Index n_corners, FitOptions const& options) noexcept {
    for (Index k = 0; k < course_.n_positions; ++k) {
        along_[k] = along_[place_[k]];
        curvature_[k] = curvature_[place_[k]];
        best_u_[k] = best_u_[place_[k]];
    }
    for (Index& position : corner_.first(n_corners)) position = position_at(position);
    for (Index& position : best_pinned_)
        if (position != none) position = position_at(position);
    weigh_points(course_.n_positions, options);
}

void Fit::keep() noexcept {
    copy(kept_control_, Span<const Real>(control));
    copy(kept_knots_, Span<const Real>(best_knots_));
    copy(kept_pinned_, Span<const Index>(best_pinned_));
    for (Index k = 0; k < course_.n_positions; ++k) kept_u_[k] = best_u_[k];
}

void Fit::restore() noexcept {
    copy(control, Span<const Real>(kept_control_.first(control.size())));
    copy(best_knots_, Span<const Real>(kept_knots_));
    copy(knots_, Span<const Real>(kept_knots_));
    copy(best_pinned_, Span<const Index>(kept_pinned_.first(best_pinned_.size())));
    for (Index k = 0; k < course_.n_positions; ++k) best_u_[k] = kept_u_[k];
}

// A curve with weights or smoothing may leave the points, one with as many control points as points
// interpolates the points, and one with large errors has too few control points; inserted points
// would not help.
void Fit::stay_near_polygon(Index n_corners, FitOptions const& options) noexcept {
    bool const interpolates = squares_.curve.n_control + 1 >= course_.n_positions;
    if (options.weight != nullptr || options.smoothing > 0 || interpolates) return;
    fill(marked_, Index(0));
    Real departure = mark_departures(), error = error_at_points();
    for (Index round = 0; round < insertion_rounds && departure > 2 * error; ++round) {
        keep();
        Index const n = insert_points(near_polygon * (1 - nearer_by * static_cast<Real>(round)));
        for (Index& position : corner_.first(n_corners)) position = place_[position];
        weigh_points(n, options);
        Real const kept_error = best_error_;
        if (grows(n)) approximate(n_corners, rounds_of_knots);
        else best_error_ = infinity;
        bool const fits = best_error_ < infinity;
        remove_inserted(n_corners, options);
        if (!fits) restore();
        Real const now = mark_departures(), error_now = error_at_points();
        best_error_ = kept_error;
        bool const is_better = max(now / near_polygon, error_now / tolerable_error) <
                               max(departure / near_polygon, error / tolerable_error);
        if (fits && is_better && find_backtrack() == none) {
            departure = now;
            error = error_now;
        } else {
            restore();
        }
    }
}

}  // namespace harmorph
