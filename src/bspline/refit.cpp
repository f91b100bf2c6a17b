#include "bspline/refit.hpp"

#include "base/vec2.hpp"
#include "bspline/projection.hpp"

namespace harmorph {
namespace {

constexpr Index samples_per_span = 32;     // samples of the curve, which give the shares of the arc
constexpr Index samples_per_control = 12;  // a lower bound for the samples of the points
constexpr Index min_samples = 400;
constexpr Index max_rounds = 60;
constexpr Real first_along = 0.05, last_along = 1e-4;  // see LeastSquares::solve
constexpr Real max_slide = 0.02;  // as a fraction of the extent, see Refit::solve
constexpr Real settled = 1e-11;   // a smaller change of the control points ends the rounds
// The ends of an outline are closer to each other than this share of the chord.
constexpr Real max_gap = 0.5;

Index count_spans(Curve const& curve) noexcept {
    Index n = 0;
    for (Index span = curve.degree; span < curve.n_indices; ++span)
        n += curve.knots[span] < curve.knots[span + 1] ? 1 : 0;
    return n;
}

Closure closure_of(Curve const& curve) noexcept {
    Index const n = curve.n_indices;
    if (curve.control_point(0) == curve.control_point(n - 1)) return Closure::tied;
    for (Index k = 0; k < curve.degree; ++k) {
        if (curve.control_point(k) != curve.control_point(n - curve.degree + k))
            return Closure::open;
    }
    return Closure::periodic;
}

// A periodic curve repeats the first `degree` control points at the end; a tied curve repeats the
// first control point.
Index count_distinct(Curve const& curve, Closure closure) noexcept {
    if (closure == Closure::periodic) return curve.n_indices - curve.degree;
    return closure == Closure::tied ? curve.n_indices - 1 : curve.n_indices;
}

}  // namespace

void Refit::lay_out(Arena& arena, Curve const& curve, Index n_points) noexcept {
    Index const n = count_distinct(curve, closure_of(curve));
    arena.take(control, 2 * Offset{curve.n_control});
    arena.take(local_, curve.n_control);
    arena.take(indices_, curve.n_indices);
    arena.take(weights_, n);
    arena.take(unit_, 2 * Offset{n});
    arena.take(best_, 2 * Offset{n});
    Index const n_source = count_spans(curve) * samples_per_span + 1;
    source_.lay_out(arena, n_source);
    arena.take(source_u_, n_source);
    Index const wanted = max(min_samples, samples_per_control * n);
    samples_.lay_out(arena, n_points, wanted);
    arena.take(start_u_, samples_.max_samples());
    squares_.lay_out(arena, samples_.max_samples(), n, curve.degree);
}

Status Refit::run(Curve const& curve, Curve const* base, Points points, Index n_points,
                  RefitOptions const& options, RefitReport& report, Fault& fault) noexcept {
    report = {};
    HARMORPH_TRY(take_curve(curve, fault));
    HARMORPH_TRY(samples_.take(points, n_points, options.is_loop, fault));
    HARMORPH_TRY(place_samples(options, report, fault));
    start_parameters();
    solve();
    publish(curve, base);
    measure_errors(curve, base, n_points, report);
    if (is_finite(report.max_error)) return Status::ok;
    return fault.refuse(Status::bad_curve, "the points do not determine the curve on these knots");
}

Status Refit::take_curve(Curve const& curve, Fault& fault) noexcept {
    closure_ = closure_of(curve);
    Index const n = count_distinct(curve, closure_);
    fill(local_, none);
    Box box;
    for (Index k = 0; k < n; ++k) {
        Index const i = curve.control_point(k);
        if (local_[i] != none)
            return fault.refuse(
                Status::bad_curve,
                "the curve uses control point # twice, and not only where it closes",
                control_point_item(i));
        local_[i] = k;
        box.include(curve.point(k));
    }
    centre_ = 0.5 * (box.low + box.high);
    extent_ = box.extent();
    if (!(extent_ > 0))
        return fault.refuse(Status::bad_curve,
                            "all control points of the curve are in the same place");
    own_ = curve;
    for (Index k = 0; k < n; ++k) {
        Vec2 const p = to_unit(curve.point(k));
        unit_[2 * k] = p.x;
        unit_[2 * k + 1] = p.y;
    }
    for (Index k = 0; k < n; ++k) weights_[k] = curve.weight(curve.control_point(k));
    for (Index k = 0; k < curve.n_indices; ++k) indices_[k] = k % n;
    if (curve.weights != nullptr) own_.weights = weights_.data();
    own_.indices = indices_.data();
    own_.index_base = 0;
    own_.n_control = n;
    own_.control = unit_.data();
    sample_curve();
    bool const has_extent = source_.measure();
    Real const gap = length(source_.at[source_.n - 1] - source_.at[0]);
    if (has_extent && gap < max_gap * length(source_.trailing - source_.leading)) return Status::ok;
    return fault.refuse(Status::bad_curve,
                        "the curve is not the outline of an airfoil from the trailing edge round "
                        "to the trailing edge");
}

// A periodic curve has no trailing edge, so the samples begin at the largest x.
void Refit::sample_curve() noexcept {
    Index n = 0, first = 0;
    for (Index span = own_.degree; span < own_.n_indices; ++span) {
        Real const low = own_.knots[span], width = own_.knots[span + 1] - low;
        for (Index j = 0; j < samples_per_span && width > 0; ++j)
            source_u_[n++] = low + width * j / samples_per_span;
    }
    source_u_[n++] = own_.end();
    source_.n = 0;
    for (Index k = 0; k < n; ++k) {
        source_.add(curve_point(own_, source_u_[k]));
        if (source_.at[k].x > source_.at[first].x) first = k;
    }
    if (closure_ != Closure::periodic) return;
    source_.begin_at(first);
    begin_loop_at(source_u_.first(n), first);
}

Status Refit::place_samples(RefitOptions const& options, RefitReport& report,
                            Fault& fault) noexcept {
    AirfoilLine& line = samples_.line;
    Closure const found = samples_.course.closure;
    if (!options.on_chord) samples_.begin_at_farthest(source_.trailing - source_.leading);
    else if (found == Closure::periodic) samples_.begin_at_farthest({1, 0});
    if (line.runs_clockwise() != source_.runs_clockwise()) line.reverse();
    line.measure();
    Vec2 const chord = line.trailing - line.leading;
    if (options.on_chord) {
        rotation_ = quotient(source_.trailing - source_.leading, chord);
        shift_ = source_.leading - product(rotation_, line.leading);
    } else {
        rotation_ = {samples_.points.extent / extent_, 0};
        shift_ = to_unit(samples_.points.centre);
    }
    report.rotation = (extent_ / samples_.points.extent) * rotation_;
    report.shift = centre_ + extent_ * shift_ - product(report.rotation, samples_.points.centre);
    for (Index k = 0; k < line.n; ++k) line.at[k] = placed(line.at[k]);
    report.chord = extent_ * length(product(rotation_, chord));
    Real const gap = length(line.at[line.n - 1] - line.at[0]);
    if (!(gap * extent_ < max_gap * report.chord))
        return fault.refuse(Status::bad_curve,
                            "the points are not the outline of an airfoil from the trailing edge "
                            "round to the trailing edge");
    bool const is_blunt = found == Closure::open;
    if (closure_ == Closure::open && !is_blunt)
        return fault.refuse(Status::bad_curve,
                            "the trailing edge of the points is sharp, but the curve has a blunt "
                            "base, which cannot vanish");
    if (closure_ != Closure::open && is_blunt) {
        report.closed_width = extent_ * gap;
        taper();
    }
    return Status::ok;
}

// Moves both ends to the middle between them; each side moves in proportion to the arc from the
// leading edge.
void Refit::taper() noexcept {
    AirfoilLine& line = samples_.line;
    Vec2 const first = line.at[0], last = line.at[line.n - 1];
    for (Index k = 0; k < line.n; ++k)
        line.at[k] = line.at[k] + (0.5 * (1 - line.share[k])) * (last - first);
    line.at[line.n - 1] = line.at[0];
}

// The initial parameter of each sample is that with the same share of the arc. Along a periodic
// curve, the samples begin where the parameters begin, and the sample that closes the line is
// omitted.
void Refit::start_parameters() noexcept {
    AirfoilLine& line = samples_.line;
    Real const period = own_.end() - own_.begin();
    Span<Real> const u = squares_.u;
    Index first = 0;
    for (Index k = 0; k < line.n; ++k) {
        Real position;
        Index const i = source_.interval_of(line.share[k], position);
        Real low = source_u_[i], high = source_u_[i + 1];
        if (high < low) high += period;
        u[k] = low + position * (high - low);
        if (u[k] > own_.end()) u[k] -= period;
        if (u[k] < u[first]) first = k;
    }
    if (closure_ == Closure::periodic) {
        line.begin_at(first);
        begin_loop_at(u.first(line.n), first);
        line.n -= 1;
    }
    squares_.set_up(own_, line.at.first(line.n));
    squares_.start();
    copy(start_u_.first(line.n), Span<const Real>(squares_.u));
    fill(squares_.weight, Real(1));
    fill(squares_.pinned, none);
    if (closure_ == Closure::periodic) return;
    squares_.pinned[0] = 0;
    if (closure_ == Closure::open) squares_.pinned[own_.n_control - 1] = line.n - 1;
}

// Returns the largest distance by which a sample has moved along the curve since its parameter was
// found from the share of the arc.
Real Refit::largest_slide() const noexcept {
    Real largest = 0;
    for (Index k = 0; k < squares_.u.count(); ++k) {
        Vec2 c[2];
        curve_point(squares_.curve, squares_.u[k], 1, c);
        largest = max(largest, abs(squares_.u[k] - start_u_[k]) * length(c[1]));
    }
    return largest;
}

// Each round brings the curve nearer to the samples, but lets the parameters slide along the curve.
// The rounds end before the slide distorts the mesh, because wall points move with their
// parameters.
void Refit::solve() noexcept {
    copy(best_, Span<const Real>(unit_));
    Real best_error = infinity, along = 1;
    for (Index round = 0; round < max_rounds; ++round) {
        squares_.solve(along);
        along = max(first_along * along, last_along);
        Real const error = squares_.correct_parameters();
        if (round > 0 && largest_slide() > max_slide) return;
        if (!(error < best_error)) continue;
        best_error = error;
        Real change = 0;
        for (Index i = 0; i < best_.count(); ++i)
            change = max(change, abs(squares_.control[i] - best_[i]));
        copy(best_, Span<const Real>(squares_.control));
        if (change < settled) return;
    }
}

// The control points of the straight base keep their places relative to both ends, which belong to
// the airfoil, too.
void Refit::publish(Curve const& curve, Curve const* base) noexcept {
    for (Index i = 0; i < control.count(); ++i) control[i] = curve.control[i];
    auto const old_place = [&](Index i) {
        return Vec2{curve.control[2 * i], curve.control[2 * i + 1]};
    };
    auto const new_place = [&](Index i) { return Vec2{control[2 * i], control[2 * i + 1]}; };
    auto const move = [&](Index i, Vec2 to) {
        control[2 * i] = to.x;
        control[2 * i + 1] = to.y;
    };
    for (Index i = 0; i < local_.count(); ++i) {
        if (local_[i] == none) continue;
        Index const k = local_[i];
        move(i, centre_ + extent_ * Vec2{best_[2 * k], best_[2 * k + 1]});
    }
    if (base == nullptr) return;
    Index const a = base->control_point(0), b = base->control_point(base->n_indices - 1);
    Vec2 const rotation = quotient(new_place(b) - new_place(a), old_place(b) - old_place(a));
    for (Index k = 1; k + 1 < base->n_indices; ++k) {
        Index const i = base->control_point(k);
        move(i, new_place(a) + product(rotation, old_place(i) - old_place(a)));
    }
}

void Refit::measure_errors(Curve const& curve, Curve const* base, Index n,
                           RefitReport& report) const noexcept {
    Curve moved[2] = {curve, base != nullptr ? *base : curve};
    moved[0].control = moved[1].control = control.data();
    Real sum = 0;
    for (Index k = 0; k < n; ++k) {
        Vec2 const p = centre_ + extent_ * placed(samples_.points.at[k]);
        Real distance = project(moved[0], p).distance;
        if (base != nullptr) distance = min(distance, project(moved[1], p).distance);
        sum += distance * distance;
        if (k > 0 && distance <= report.max_error) continue;
        report.max_error = distance;
        report.max_error_point = k;
    }
    report.rms_error = sqrt(sum / n);
}

}  // namespace harmorph
