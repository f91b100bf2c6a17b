#include "bspline/finer_curves.hpp"

namespace harmorph {

bool has_periodic_points(Curve const& curve) noexcept {
    Index const p = curve.degree, n = curve.n_indices - p;
    if (curve.indices == nullptr || n < 1) return false;
    Real const period = curve.end() - curve.begin();
    for (Index k = 0; k < p; ++k) {
        if (curve.indices[k] != curve.indices[k + n]) return false;
    }
    for (Index k = 0; k <= 2 * p; ++k) {
        if (!(abs(curve.knots[k + n] - curve.knots[k] - period) <= 1e-12 * period)) return false;
    }
    return true;
}

Status CurveRefinement::check(Curve const& old, Fault& fault) const noexcept {
    if (elevates) {
        if (old.degree < max_degree) return Status::ok;
        return fault.refuse(
            Status::bad_curve,
            "the degree of curve # cannot be raised, because @ is the largest degree",
            curve_item(curve), plain(old.degree));
    }
    bool const periodic = has_periodic_points(old);
    for (Index k = 0; k < knots.count(); ++k) {
        Real const u = knots[k];
        bool const inside =
            is_finite(u) && (u > old.begin() || (periodic && u == old.begin())) && u < old.end();
        if (!inside) {
            return fault.refuse(Status::bad_argument,
                                "knot # to be inserted, ~, is not inside the range of curve @",
                                knot_item(k), curve_item(curve), u);
        }
        Index fold = 0;
        for (Real const other : knots) fold += other == u ? 1 : 0;
        for (Index i = 0; i < old.n_indices + old.degree + 1; ++i)
            fold += old.knots[i] == u ? 1 : 0;
        if (fold > old.degree) {
            return fault.refuse(
                Status::bad_curve,
                "knot #, ~, would be repeated @ times, more often than the degree allows",
                knot_item(k), plain(fold), u);
        }
    }
    return Status::ok;
}

// A knot is inserted with its images one period before and after it; a raised degree at most
// doubles the knots.
Index CurveRefinement::max_knots(Curve const& old) const noexcept {
    Index const n = old.n_indices + old.degree + 1;
    return max_order + (elevates ? 2 * n : n + 3 * knots.count());
}

Real polar_form(Curve const& curve, Index span, const Real* argument, Real* value) noexcept {
    value[0] = 1;
    Real largest = 1;
    for (Index j = 1; j <= curve.degree; ++j) {
        Real const* const low = curve.knots + span + 1 - j;
        Real const* const high = curve.knots + span + 1;
        Real const u = argument[j - 1];
        Real carried = 0;
        for (Index r = 0; r < j; ++r) {
            Real const before = value[r], width = high[r] - low[r];
            value[r] = carried + (high[r] - u) / width * before;
            carried = (u - low[r]) / width * before;
            largest = max(largest, abs(value[r]));
        }
        value[j] = carried;
        largest = max(largest, abs(carried));
    }
    return largest;
}

void FinerCounts::include(Curve const& old, bool changes,
                          CurveRefinement const& refinement) noexcept {
    ++n_curves;
    n_control = old.n_control;
    rational = old.weights != nullptr;
    if (changes) {
        max_knots = refinement.max_knots(old);
    } else {
        other_indices += old.n_indices;
        other_knots += old.n_indices + old.degree + 1;
    }
}

void FinerCurves::lay_out(Arena& arena, FinerCounts const& counts) noexcept {
    old_control = counts.n_control;
    arena.take(curve, counts.n_curves);
    arena.take(control, 2 * counts.max_control());
    arena.take(weights, counts.rational ? counts.max_control() : 0);
    arena.take(matrix, counts.max_control() * counts.n_control);
    arena.take(all_, counts.max_knots);
    arena.take(knots_, counts.max_knots);
    arena.take(indices_, counts.max_knots);
    arena.take(other_indices_, counts.other_indices);
    arena.take(other_knots_, counts.other_knots);
    arena.take(number_, counts.n_control);
    arena.take(of_changed_, counts.n_control);
    arena.take(of_others_, counts.n_control);
}

// ---- Knots of the changed curve

void FinerCurves::insert(Curve const& old, Span<const Real> knots) noexcept {
    n_all_ = old.n_indices + old.degree + 1;
    copy(all_.first(n_all_), Span<const Real>(old.knots, static_cast<Size>(n_all_)));
    Real const first = all_[0], last = all_[n_all_ - 1], period = old.end() - old.begin();
    auto const add = [&](Real u) {
        if (u < first || u > last) return;
        Index k = n_all_++;
        for (; k > 0 && u < all_[k - 1]; --k) all_[k] = all_[k - 1];
        all_[k] = u;
    };
    for (Real const u : knots) {
        add(u);
        if (period_ == 0) continue;
        add(u - period);
        add(u + period);
    }
}

void FinerCurves::repeat_each_knot(Curve const& old) noexcept {
    n_all_ = 0;
    for (Index k = 0; k < old.n_indices + old.degree + 1; ++k) {
        if (k == 0 || old.knots[k] != old.knots[k - 1]) all_[n_all_++] = old.knots[k];
        all_[n_all_++] = old.knots[k];
    }
}

// Copies the knots that the curve needs from all_ to knots_. knots_[degree] is the last knot at the
// beginning, and knots_[n_positions] the first knot at the end; for a periodic curve it is the last
// knot at the end, as at the beginning.
void FinerCurves::choose_window(Curve const& old, Index degree) noexcept {
    Index begin = 0, end = n_all_ - 1;
    while (begin + 1 < n_all_ && all_[begin + 1] <= old.begin()) ++begin;
    while (end > 0 && all_[end - 1] >= old.end()) --end;
    if (period_ != 0) {
        while (end + 1 < n_all_ && all_[end + 1] <= old.end()) ++end;
        period_ = end - begin;
        for (; n_all_ <= end + degree; ++n_all_)
            all_[n_all_] = all_[n_all_ - period_] + (old.end() - old.begin());
    }
    degree_ = degree;
    n_positions_ = end - begin + degree;
    copy(knots_.first(n_positions_ + degree + 1),
         Span<const Real>(all_).from(begin - degree, n_positions_ + degree + 1));
}

// ---- Control points

// Computes a new control point with these knots, as coefficients of the control points of one span
// of the old curve. Returns the largest intermediate number.
Real FinerCurves::coefficients(Curve const& old, Index span, const Real* argument,
                               Real* sum) const noexcept {
    for (Index k = 0; k < max_order; ++k) sum[k] = 0;
    for (Index i = span - old.degree; i <= span && degree_ == old.degree; ++i) {
        bool equal = true;
        for (Index r = 0; r < degree_; ++r) equal = equal && old.knots[i + 1 + r] == argument[r];
        if (!equal) continue;
        sum[i - (span - old.degree)] = 1;  // the new control point is an old one
        return 0;
    }
    Real largest = 0;
    for (Index left_out = 0; left_out < (degree_ > old.degree ? degree_ : 1); ++left_out) {
        Real chosen[max_order], value[max_order];
        for (Index r = 0, n = 0; n < old.degree; ++r) {
            if (degree_ == old.degree || r != left_out) chosen[n++] = argument[r];
        }
        largest = max(largest, polar_form(old, span, chosen, value));
        for (Index k = 0; k <= old.degree; ++k) sum[k] += value[k];
    }
    if (degree_ > old.degree) {
        for (Index k = 0; k < max_order; ++k) sum[k] /= degree_;
    }
    return largest;
}

// Appends the row of the control point at a position to the matrix. The coefficients can be
// computed from each span in which the control point counts; for a periodic curve, also one period
// later. The span with the smallest intermediate numbers is used, because large numbers would
// cancel far from the arguments of the polar form.
void FinerCurves::put_row(Curve const& old, Index position) noexcept {
    Real sum[max_order] = {}, smallest = 0;
    Index span = none;
    for (Index at = position; at < n_positions_; at += period_) {
        for (Index new_span = max(at, degree_); new_span <= min(at + degree_, n_positions_ - 1);
             ++new_span) {
            if (!(knots_[new_span] < knots_[new_span + 1])) continue;
            Real candidate[max_order];
            Index const old_span = knot_span(old, knots_[new_span]);
            Real const largest = coefficients(old, old_span, knots_.data() + at + 1, candidate);
            if (span != none && !(largest < smallest)) continue;
            for (Index k = 0; k < max_order; ++k) sum[k] = candidate[k];
            smallest = largest;
            span = old_span;
        }
        if (period_ == 0) break;
    }
    Span<Real> const row = matrix.from(Offset{n_control} * old_control, old_control);
    fill(row, 0.0);
    Real weight = 0;
    for (Index k = 0; k <= old.degree; ++k) {
        Index const i = span - old.degree + k;
        Real const term = sum[k] * old.weight(i);
        weight += term;
        row[old.control_point(i)] += term;
    }
    if (weights.empty()) return;
    for (Real& number : row) number /= weight;
    weights[n_control] = weight;
}

void FinerCurves::number_changed(Curve const& old) noexcept {
    n_control = 0;
    for (Index position = 0; position < n_positions_; ++position) {
        if (period_ != 0 && position >= period_) {
            indices_[position] = indices_[position - period_];
            continue;
        }
        put_row(old, position);
        Span<const Real> const row = matrix.from(Offset{n_control} * old_control, old_control);
        // The new control point is an old one if its row has a single entry 1.
        Index same = none, others = 0;
        for (Index i = 0; i < old_control; ++i) {
            if (row[i] == 1) same = i;
            else if (row[i] != 0) ++others;
        }
        bool const untouched = same != none && others == 0;
        if (untouched && number_[same] != none) {
            indices_[position] = number_[same];
            continue;
        }
        if (untouched) number_[same] = n_control;
        indices_[position] = n_control++;
    }
}

// Keeps the old control points that other curves need, or that no curve uses.
void FinerCurves::number_others(Index changed) noexcept {
    Curve const& any = curve[changed];
    for (Index i = 0; i < old_control; ++i) {
        if (number_[i] != none || (of_changed_[i] != 0 && of_others_[i] == 0)) continue;
        Span<Real> const row = matrix.from(Offset{n_control} * old_control, old_control);
        fill(row, 0.0);
        row[i] = 1;
        if (!weights.empty()) weights[n_control] = any.weights[i];
        number_[i] = n_control++;
    }
}

void FinerCurves::publish(Index changed, Curve const& old) noexcept {
    const Real* const from = old.control;
    for (Index k = 0; k < n_control; ++k) {
        Vec2 sum;
        for (Index i = 0; i < old_control; ++i) {
            Real const entry = matrix[Offset{k} * old_control + i];
            if (entry != 0) sum = sum + entry * Vec2{from[2 * i], from[2 * i + 1]};
        }
        control[2 * k] = sum.x;
        control[2 * k + 1] = sum.y;
    }
    Index const base = old.index_base;
    for (Index k = 0; k < n_positions_; ++k) indices_[k] += base;
    Offset used_indices = 0, used_knots = 0;
    for (Index c = 0; c < curve.count(); ++c) {
        Curve& view = curve[c];
        if (c == changed) {
            view.degree = degree_;
            view.n_indices = n_positions_;
            view.indices = indices_.data();
            view.knots = knots_.data();
        } else {
            Index* const indices = other_indices_.data() + used_indices;
            Real* const knots = other_knots_.data() + used_knots;
            Index const n_knots = view.n_indices + view.degree + 1;
            for (Index k = 0; k < view.n_indices; ++k)
                indices[k] = number_[view.control_point(k)] + base;
            for (Index k = 0; k < n_knots; ++k) knots[k] = view.knots[k];
            used_indices += view.n_indices;
            used_knots += n_knots;
            view.indices = indices;
            view.knots = knots;
        }
        view.n_control = n_control;
        view.control = control.data();
        view.weights = weights.empty() ? nullptr : weights.data();
    }
}

Status FinerCurves::run(CurveRefinement const& refinement, Fault& fault) noexcept {
    Curve const old = curve[refinement.curve];
    period_ = has_periodic_points(old) ? 1 : 0;
    if (refinement.elevates) repeat_each_knot(old);
    else insert(old, refinement.knots);
    choose_window(old, old.degree + (refinement.elevates ? 1 : 0));

    fill(number_, none);
    fill(of_changed_, std::uint8_t{0});
    fill(of_others_, std::uint8_t{0});
    for (Index c = 0; c < curve.count(); ++c) {
        Span<std::uint8_t> const users = c == refinement.curve ? of_changed_ : of_others_;
        for (Index k = 0; k < curve[c].n_indices; ++k) users[curve[c].control_point(k)] = 1;
    }
    number_changed(old);
    number_others(refinement.curve);
    publish(refinement.curve, old);
    return check_curve(curve[refinement.curve], refinement.curve, fault);
}

}  // namespace harmorph
