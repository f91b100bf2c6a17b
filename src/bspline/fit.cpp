#include "bspline/fit.hpp"

#include <limits>

#include "base/angle.hpp"

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
// so that the turn of the corner does not attract knots.
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

}  // namespace harmorph
