#include "bspline/fit.hpp"

#include <limits>

#include "base/vec2.hpp"
#include "bspline/projection.hpp"

namespace harmorph {
namespace {

constexpr Index knot_rounds = 24;      // each round moves knots to where the errors are
constexpr Index solves_per_round = 3;  // a correction of the parameters follows each solve
constexpr Index final_solves = 20;     // the final solves use the best knots
constexpr Real exact = 1e-14;          // errors below this fraction of the extent are rounding

// Each round makes this part of the change of the knots that the errors ask for. With the whole
// change in each round, more than 12 knots jump to and fro, and rounding of the points grows from
// round to round up to the distance of the points.
Real pace_of_knots(Index n_control, Index round) noexcept {
    Real const many = static_cast<Real>(max(n_control - 12, Index(0))) / 28;  // 1: 40
    Real const first = 1 / (1 + 1.5 * many);
    return first / (1 + first * min(Real(1), many) * static_cast<Real>(round));
}

}  // namespace

Status check_fit(Index n_points, FitOptions const& options, Fault& fault) noexcept {
    if (options.degree < 1 || options.degree > max_degree)
        return fault.refuse(Status::bad_curve, "the degree of a fit must be 1 to 5, not #",
                            plain(options.degree));
    if (options.n_control <= options.degree)
        return fault.refuse(Status::bad_curve,
                            "# control points are too few: a fit needs more than the degree, @",
                            plain(options.n_control), plain(options.degree));
    if (n_points < options.n_control)
        return fault.refuse(Status::bad_curve, "# points are too few to determine @ control points",
                            plain(n_points), plain(options.n_control));
    if (n_points > (std::numeric_limits<Index>::max() - 2 * max_order) / (1 + inserted_points) - 1)
        return fault.refuse(Status::bad_curve, "# points are too many for a fit", plain(n_points));
    return Status::ok;
}

void Fit::lay_out(Arena& arena, Index n_points, FitOptions const& options) noexcept {
    Offset const n = n_points;
    Offset const m = options.n_control;
    Offset const p = options.degree;
    Offset const room = (1 + inserted_points) * n + 1;  // points along the curve
    arena.take(control, 2 * m);
    arena.take(indices_, m + p);
    arena.take(knots_, m + 2 * p + 1);
    arena.take(base_indices_, 2);
    arena.take(base_knots_, 4);
    arena.take(best_knots_, m + 2 * p + 1);
    arena.take(best_pinned_, m);
    arena.take(span_error_, m + p);
    arena.take(best_u_, room);
    arena.take(section_spans_, m);
    points_.lay_out(arena, n_points);
    arena.take(corner_, n);
    arena.take(along_, room);
    arena.take(arc_, room);
    arena.take(curvature_, room);
    arena.take(start_, room);
    arena.take(mass_, room);
    arena.take(capped_, room);
    arena.take(marked_, n + 1);
    arena.take(place_, n + 1);
    arena.take(kept_control_, 2 * m);
    arena.take(kept_knots_, m + 2 * p + 1);
    arena.take(kept_u_, n + 1);
    arena.take(kept_pinned_, m);
    outline_.lay_out(arena, n_points);
    squares_.lay_out(arena, room, options.n_control, options.degree);
}

Status Fit::run(Points points, Index n, bool is_loop, FitOptions const& options, FitReport& report,
                Fault& fault) noexcept {
    HARMORPH_TRY(check_fit(n, options, fault));
    HARMORPH_TRY(points_.take(points, n, is_loop, fault));
    outline_.points = points_.at;
    outline_.is_loop = is_loop;
    if (!is_loop && (options.closure == Closure::tied || options.closure == Closure::periodic))
        return fault.refuse(Status::bad_curve,
                            "a tied or periodic curve needs points that form a closed loop");
    if (!(options.tolerance > 0)) return attempt(points, n, options, report, fault);
    FitOptions fewer = options;
    for (fewer.n_control = options.degree + 1;;) {
        bool const is_last = fewer.n_control == options.n_control;
        Fault why;
        Status const status = attempt(points, n, fewer, report, is_last ? fault : why);
        if (status == Status::ok && report.max_error <= options.tolerance) return status;
        if (is_last && status != Status::ok) return status;
        if (is_last) break;
        fewer.n_control =
            min(options.n_control, fewer.n_control + max(Index(1), fewer.n_control / 8));
    }
    return fault.refuse(Status::far_from_points,
                        "with # control points the largest error of the fit is ~, above the "
                        "tolerance",
                        plain(options.n_control), {}, report.max_error);
}

Status Fit::attempt(Points points, Index n, FitOptions const& options, FitReport& report,
                    Fault& fault) noexcept {
    outline_.measure();
    Index n_corners = drop_facets(outline_, corner_, find_corners(outline_, corner_));
    report = {};
    report.corners = n_corners;
    course_ = choose_course(outline_, corner_.first(n_corners), options.closure);
    if (course_.n_positions < options.n_control)
        return fault.refuse(Status::bad_curve,
                            "without the points on the blunt base, # points are too few to "
                            "determine @ control points",
                            plain(course_.n_positions), plain(options.n_control));
    shape_curve(options);
    HARMORPH_TRY(check_tangents(options, fault));
    Index const max_corners = corners_possible(options.degree, squares_.curve.n_indices);
    n_corners = corners_on(course_, outline_, corner_.first(n_corners), max_corners);
    gather(n_corners, options);
    use_details(options);
    HARMORPH_TRY(check_growth(fault));
    approximate(n_corners, knot_rounds);
    if (best_error_ < infinity) stay_near_polygon(n_corners, options);
    constexpr const char* undetermined =
        "the points do not determine the curve; use fewer control points";
    if (best_error_ == infinity) return fault.refuse(Status::bad_curve, undetermined);
    report_departure(report);
    report.backtrack_point = find_backtrack();
    publish(points);
    // Control points may lie too far away, and knots too close together.
    for (Index c = 0; c < n_curves; ++c) {
        Fault why;
        if (failed(check_curve(curve[c], c, why)))
            return fault.refuse(Status::bad_curve, undetermined);
    }
    report_errors(points, n, options, report);
    if (!is_finite(report.max_error)) return fault.refuse(Status::bad_curve, undetermined);
    if (report.backtrack_point == none) return Status::ok;
    Index const next = report.backtrack_point + 1 == n ? 0 : report.backtrack_point + 1;
    return fault.refuse(Status::backtracks,
                        "the fitted curve runs backwards between points # and @; use fewer control "
                        "points",
                        point_item(report.backtrack_point), point_item(next));
}

// Lengths are divided by the extent of the points, and parameters are parts of the arc length S, so
// that L^4 times the integral of |C''|^2 by the arc length is L^4 / S^3 times that by the
// parameter.
void Fit::use_details(FitOptions const& options) noexcept {
    Real const part = options.smoothing / points_.extent, arc = arc_[course_.n_positions - 1];
    squares_.bending = part * part * part * part / (arc * arc * arc);
    squares_.speed = arc;
    for (Index end = 0; end < 2; ++end) squares_.direction[end] = direction(options.tangent[end]);
}

Status Fit::check_tangents(FitOptions const& options, Fault& fault) const noexcept {
    bool const asked = square(options.tangent[0]) > 0 || square(options.tangent[1]) > 0;
    if (!asked) return Status::ok;
    if (course_.closure == Closure::periodic)
        return fault.refuse(Status::bad_curve,
                            "a periodic curve has no ends, and so takes no end tangents");
    if (options.degree < 2 || options.n_control < 4)
        return fault.refuse(Status::bad_curve,
                            "end tangents need a degree of at least 2 and 4 control points");
    Index const last = course_.n_positions - 1;
    auto const step = [&](Index from) {
        return points_.at[point_at(from + 1)] - points_.at[point_at(from)];
    };
    for (Index end = 0; end < 2; ++end) {
        if (!(dot(step(end == 0 ? 0 : last - 1), options.tangent[end]) < 0)) continue;
        return fault.refuse(Status::bad_curve,
                            end == 0 ? "the points leave the first end of the curve against the "
                                       "tangent that is given there"
                                     : "the points reach the last end of the curve against the "
                                       "tangent that is given there");
    }
    return Status::ok;
}

void Fit::shape_curve(FitOptions const& options) noexcept {
    Curve shape;
    shape.degree = options.degree;
    shape.n_control = options.n_control;
    shape.n_indices = options.n_control;
    if (course_.closure == Closure::tied) shape.n_indices += 1;
    if (course_.closure == Closure::periodic) shape.n_indices += options.degree;
    for (Index k = 0; k < shape.n_indices; ++k) indices_[k] = k % options.n_control;
    shape.indices = course_.closes() ? indices_.data() : nullptr;
    shape.knots = knots_.data();
    squares_.set_up(shape, along_.first(course_.n_positions));
    // The arrays have room for the largest number of control points.
    control = {control.data(), 2 * static_cast<Size>(shape.n_control)};
    best_pinned_ = {best_pinned_.data(), static_cast<Size>(shape.n_control)};
}

// Collects the points and their curvature along the curve. A corner gets the curvature beside it,
// so that the turning of the corner does not attract knots.
void Fit::gather(Index n_corners, FitOptions const& options) noexcept {
    Index const m = course_.n_positions;
    for (Index k = 0; k < m; ++k) {
        Index const point = point_at(k);
        along_[k] = points_.at[point];
        curvature_[k] = outline_.curvature[point];
    }
    if (course_.closure != Closure::periodic) {
        curvature_[0] = curvature_[1];
        curvature_[m - 1] = curvature_[m - 2];
    }
    for (Index const k : corner_.first(n_corners))
        curvature_[k] = min(curvature_[k - 1], curvature_[k + 1]);
    weigh_points(m, options);
}

// Gives the n points along the curve parameters and weights.
void Fit::weigh_points(Index n, FitOptions const& options) noexcept {
    squares_.set_up(squares_.curve, along_.first(n));
    for (Index k = 0; k < n; ++k)
        arc_[k] = k == 0 ? 0 : arc_[k - 1] + length(along_[k] - along_[k - 1]);
    for (Index k = 0; k < n; ++k) {
        start_[k] = arc_[k] / arc_[n - 1];
        Real const reach = arc_[min(k + 1, n - 1)] - arc_[max(k - 1, Index(0))];
        // With these weights, the sum of squares approximates the integral along the curve.
        Real const weight = options.weight != nullptr ? options.weight[point_at(k)] : 1;
        squares_.weight[k] = 0.5 * reach * weight;
    }
    sites_.u = start_.first(n);
    sites_.mass = mass_.first(n - 1);
    sites_.capped = capped_.first(n - 1);
}

// Refuses equal parameters: the knots between them would be equal, more often than the degree
// allows.
bool Fit::grows(Index n) const noexcept {
    for (Index k = 0; k + 1 < n; ++k)
        if (!(start_[k] < start_[k + 1])) return false;
    return true;
}

Status Fit::check_growth(Fault& fault) const noexcept {
    for (Index k = 0; k + 1 < course_.n_positions; ++k) {
        if (start_[k] < start_[k + 1]) continue;
        return fault.refuse(Status::bad_curve,
                            "the consecutive points # and @ are equal to rounding",
                            point_item(point_at(k)), point_item(point_at(k + 1)));
    }
    return Status::ok;
}

void Fit::use_corners(Index n) noexcept {
    sites_.corner = corner_.first(n);
    sites_.section_spans = section_spans_.first(n + 1);
}

// A control point lies on the curve if the knots that follow it are equal, as many as the degree.
void Fit::pin_ends_and_corners() noexcept {
    Curve const& shape = squares_.curve;
    fill(squares_.pinned, none);
    if (course_.closure == Closure::periodic) return;
    Index const last = squares_.points.count() - 1;
    squares_.pinned[0] = 0;
    if (course_.closure == Closure::open) squares_.pinned[shape.n_control - 1] = last;
    Index i = 1;
    for (Index const corner : sites_.corner) {
        while (shape.knots[i + 1] < start_[corner]) ++i;
        squares_.pinned[i] = corner;
    }
}

void Fit::start_parameters() noexcept {
    copy(squares_.u, Span<const Real>(sites_.u));
    squares_.start();
}

// Solves and corrects the parameters several times, and keeps the best control points with their
// knots and pinned points.
void Fit::solve_and_correct(Index times, Real acceleration) noexcept {
    Real along = 0.02;
    for (Index k = 0; k < times && best_error_ > exact; ++k) {
        squares_.solve(along);
        along *= acceleration;
        Real const error = squares_.correct_parameters();
        if (!(error < best_error_)) continue;
        best_error_ = error;
        copy(control, Span<const Real>(squares_.control));
        copy(best_knots_, Span<const Real>(knots_));
        copy(best_pinned_, Span<const Index>(squares_.pinned));
        copy(best_u_, Span<const Real>(squares_.u));
    }
}

void Fit::find_knots(Index rounds) noexcept {
    Curve const& shape = squares_.curve;
    weigh_by_curvature(arc_, curvature_, sites_.mass);
    for (Index round = 0; round < rounds && best_error_ > exact; ++round) {
        place_knots(sites_, shape.degree, shape.n_indices, course_.closure == Closure::periodic,
                    knots_);
        pin_ends_and_corners();
        start_parameters();
        solve_and_correct(solves_per_round, 1);
        weigh_by_error(shape, squares_.u, squares_.error, sites_,
                       pace_of_knots(shape.n_control, round), span_error_);
    }
}

void Fit::approximate(Index n_corners, Index rounds) noexcept {
    best_error_ = infinity;
    use_corners(n_corners);
    find_knots(rounds);
    // Without corners the fit may be better, if noise was taken for corners.
    if (n_corners > 0) {
        use_corners(0);
        find_knots(rounds);
    }
    copy(knots_, Span<const Real>(best_knots_));
    copy(squares_.pinned, Span<const Index>(best_pinned_));
    start_parameters();
    solve_and_correct(final_solves, 0.7);
}

// Keeps a fitted curve near the polygon of the points. Between points that are far apart at a round
// nose, least squares alone let the curve bulge. Where the curve leaves the polygon too far, points
// are inserted: the curve's own points, drawn towards the polygon, and the fit is repeated.

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
// [radians] Where the polygon bends less from side to side, the points resolve the shape, and the
// curve may leave the polygon by the sagitta of an arc with this turning angle.
constexpr Real resolved_turning = 0.52, sagitta_margin = 1.5;

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
Real Fit::turning_at(Index position) const noexcept {
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
        Real const turning = max(turning_at(k), turning_at(k + 1));
        Real const step = length(vertex(k + 1) - vertex(k));
        Real const allowed = turning < resolved_turning
                                 ? max(near_polygon, sagitta_margin * step * turning / 8)
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

// Writes the results of a fit: control points in the caller's units, errors, and the point at which
// the curve runs backwards.

namespace {

// The direction of a shorter step between points depends on the last digits of coordinates.
constexpr Real min_step = 1e-5;
// The curve runs backwards if the cosine of the angle between the curve and the step is below this.
constexpr Real cosine_of_backtrack = -0.25;
constexpr Index samples_per_step = 32;

}  // namespace

// Converts the control points to the caller's units. A control point that is pinned at a point gets
// exactly the coordinates of the point.
void Fit::publish(Points points) noexcept {
    Index const n_control = squares_.curve.n_control;
    for (Index i = 0; i < n_control; ++i) {
        Vec2 place = points_.from_unit({control[2 * i], control[2 * i + 1]});
        Index const position = best_pinned_[i];
        if (position != none) place = points[point_at(position)];
        control[2 * i] = place.x;
        control[2 * i + 1] = place.y;
    }
    n_curves = 1;
    curve[0] = squares_.curve;
    curve[0].control = control.data();
    if (course_.base_points == 0) return;
    base_indices_[0] = n_control - 1;
    base_indices_[1] = 0;
    for (Index k = 0; k < 4; ++k) base_knots_[k] = k < 2 ? 0 : 1;
    n_curves = 2;
    curve[1] = {1,      2, 0, n_control, base_indices_.data(), base_knots_.data(), control.data(),
                nullptr};
}

// Points with weight 0 have no errors.
void Fit::report_errors(Points points, Index n, FitOptions const& options,
                        FitReport& report) const noexcept {
    report.closure = course_.closure;
    report.first_point = course_.first;
    report.base_points = course_.base_points;
    Real sum = 0;
    Index counted = 0;
    for (Index k = 0; k < n; ++k) {
        if (options.weight != nullptr && options.weight[k] == 0) continue;
        ++counted;
        Real distance = infinity;
        for (Index c = 0; c < n_curves; ++c)
            distance = min(distance, project(curve[c], points[k]).distance);
        sum += distance * distance;
        if (counted > 1 && distance <= report.max_error) continue;
        report.max_error = distance;
        report.max_error_point = k;
    }
    report.rms_error = sqrt(sum / counted);
}

// Returns the point after which the curve runs against the step to the next point, or none.
Index Fit::find_backtrack() const noexcept {
    Curve const shape = unit_curve();
    for (Index k = 0; k + 1 < course_.n_positions; ++k) {
        Vec2 const step = along_[k + 1] - along_[k];
        if (!(length(step) > min_step)) continue;
        for (Index sample = 0; sample < samples_per_step; ++sample) {
            Real const share = (sample + 0.5) / samples_per_step;
            Vec2 c[2];
            curve_point(shape, (1 - share) * best_u_[k] + share * best_u_[k + 1], 1, c);
            if (dot(c[1], step) < cosine_of_backtrack * length(c[1]) * length(step))
                return point_at(k);
        }
    }
    return none;
}

}  // namespace harmorph
