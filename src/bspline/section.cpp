#include "bspline/section.hpp"

#include "bspline/projection.hpp"

namespace harmorph {

CurvePlace Section::end_of(Index number, bool at_end) const noexcept {
    Curve const& its = curve[number];
    Real const u = at_end == backwards[number] ? its.begin() : its.end();
    return {&its, knot_span(its, u), u};
}

Real Section::extent() const noexcept {
    Vec2 low = curve[0].point(0), high = low;
    for (Index c = 0; c < n_curves; ++c) {
        for (Index k = 0; k < curve[c].n_indices; ++k) {
            Vec2 const p = curve[c].point(k);
            low = {min(low.x, p.x), min(low.y, p.y)};
            high = {max(high.x, p.x), max(high.y, p.y)};
        }
    }
    return max(high.x - low.x, high.y - low.y);
}

Status Section::connect(Fault& fault) noexcept {
    Real const near = 1e-9 * extent();
    auto const meet = [&](CurvePlace const& a, CurvePlace const& b) {
        return length(a.point() - b.point()) <= near;
    };
    for (Index c = 1; c < n_curves; ++c) {
        backwards[c] = false;
        if (meet(end_of(c - 1, true), end_of(c, false))) continue;
        backwards[c] = true;
        if (meet(end_of(c - 1, true), end_of(c, false))) continue;
        // The first curve may itself run the other way.
        if (c == 1) {
            backwards[0] = true;
            backwards[1] = false;
            if (meet(end_of(0, true), end_of(1, false))) continue;
            backwards[1] = true;
            if (meet(end_of(0, true), end_of(1, false))) continue;
        }
        return fault.refuse(
            Status::bad_curve,
            "curve @ of the section does not begin or end where the one before ends", {},
            curve_item(first_curve + c));
    }
    Curve const& last = curve[n_curves - 1];
    n_sides = n_curves > 1 && last.degree == 1 && last.n_indices == 2 ? n_curves - 1 : n_curves;
    is_closed = meet(end_of(0, false), end_of(n_curves - 1, true));
    return Status::ok;
}

Status Section::find_chord(bool wants_nose, Fault& fault) noexcept {
    if (!has_fixed_chord) {
        if (n_sides == 1 && is_periodic(curve[0])) {
            return fault.refuse(Status::bad_curve,
                                "a periodic section has no trailing edge: its chord must be given");
        }
        edge = 0.5 * (first_end().point() + last_end().point());
    }
    if (!has_fixed_chord || wants_nose) HARMORPH_TRY(find_nose(fault));
    if (!has_fixed_chord) nose = nose_place.point();
    if (square(chord()) > 0) return Status::ok;
    return fault.refuse(Status::bad_curve, "the chord of the section has no length");
}

// The largest of samples, then the zero of the slope of the squared distance beside it.
Status Section::find_nose(Fault& fault) noexcept {
    Real largest = 0, low = 0, high = 0;
    nose_place = {};
    for_each_span(0, n_sides, [&](Index c, Index span, Real from, Real to) {
        Index const n = 8 * curve[c].degree;
        for (Index j = 0; j <= n; ++j) {
            CurvePlace const place{&curve[c], span, j == n ? to : from + (to - from) * j / n};
            Real const found = square(place.point() - edge);
            if (!(found > largest)) continue;
            largest = found;
            nose_place = place;
            low = max(from, place.u - (to - from) / n);
            high = min(to, place.u + (to - from) / n);
        }
    });
    if (nose_place.curve == nullptr)
        return fault.refuse(Status::bad_curve, "the section has no extent");
    auto const slope_in = [&](Index span, Real u) {
        Vec2 c[2];
        curve_point_in(*nose_place.curve, span, u, 1, c);
        return dot(c[1], c[0] - edge);
    };
    auto const try_span = [&](Index span, Real from, Real to) {
        if (!(slope_in(span, from) >= 0 && slope_in(span, to) <= 0)) return false;
        nose_place.span = span;
        nose_place.u = sign_change(from, to, [&](Real u) { return slope_in(span, u); });
        return true;
    };
    Curve const& its = *nose_place.curve;
    Index const span = nose_place.span;
    nose_is_smooth = try_span(span, low, high);
    // The largest sample may be a knot, and the zero on its other side.
    if (!nose_is_smooth && nose_place.u == its.knots[span] && span > its.degree) {
        Index before = span - 1;
        while (before > its.degree && !(its.knots[before] < its.knots[before + 1])) --before;
        Real const width = its.knots[before + 1] - its.knots[before];
        Real const end = its.knots[before + 1];
        if (width > 0) nose_is_smooth = try_span(before, end - width / (8 * its.degree), end);
    }
    if (!nose_is_smooth && nose_place.u == its.knots[span + 1] && span + 1 < its.n_indices) {
        Index after = span + 1;
        while (after + 1 < its.n_indices && !(its.knots[after] < its.knots[after + 1])) ++after;
        Real const width = its.knots[after + 1] - its.knots[after];
        if (width > 0)
            nose_is_smooth =
                try_span(after, its.knots[after], its.knots[after] + width / (8 * its.degree));
    }
    if (nose_is_smooth) {
        Vec2 c[3];
        nose_place.derivatives(2, c);
        nose_is_smooth = square(c[1]) + dot(c[0] - edge, c[2]) < 0;
    }
    return Status::ok;
}

void Section::pull_chord(ChordDerivative const& by,
                         ControlGradient const& gradient) const noexcept {
    if (has_fixed_chord || !gradient.wanted()) return;
    pull_nose(by.nose, 0, gradient);
    gradient.add(first_end(), 0.5 * by.edge);
    gradient.add(last_end(), 0.5 * by.edge);
}

// The parameter u is where g = C' . (C - edge) = 0, hence du = -(C' . (dC - d edge) + (C - edge) .
// dC') / g'. At a corner u stays.
void Section::pull_nose(Vec2 by_point, Real by_parameter,
                        ControlGradient const& gradient) const noexcept {
    if (!gradient.wanted()) return;
    if (!nose_is_smooth) return gradient.add(nose_place, by_point);
    Vec2 c[3];
    nose_place.derivatives(2, c);
    Vec2 const away = c[0] - edge;
    Real const factor = -(by_parameter + dot(by_point, c[1])) / (square(c[1]) + dot(away, c[2]));
    Vec2 const by[2] = {by_point + factor * c[1], factor * away};
    gradient.add(nose_place, 1, by);
    if (has_fixed_chord) return;
    gradient.add(first_end(), -0.5 * factor * c[1]);
    gradient.add(last_end(), -0.5 * factor * c[1]);
}

}  // namespace harmorph
