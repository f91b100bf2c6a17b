#include "bspline/section.hpp"

#include "base/vec2.hpp"
#include "bspline/projection.hpp"

namespace harmorph {

CurvePlace Section::end_of(Index number, bool at_end) const noexcept {
    Curve const& found = curve[number];
    Real const u = at_end == backwards[number] ? found.begin() : found.end();
    return {&found, knot_span(found, u), u};
}

Real Section::extent() const noexcept {
    Box box;
    for (Index c = 0; c < n_curves; ++c) {
        for (Index k = 0; k < curve[c].n_indices; ++k) box.include(curve[c].point(k));
    }
    return box.extent();
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
        // The first curve may run in the opposite direction.
        if (c == 1) {
            backwards[0] = true;
            backwards[1] = false;
            if (meet(end_of(0, true), end_of(1, false))) continue;
            backwards[1] = true;
            if (meet(end_of(0, true), end_of(1, false))) continue;
        }
        return fault.refuse(
            Status::bad_curve,
            "curve @ of the section does not begin or end where the curve before it ends", {},
            curve_item(first_curve + c));
    }
    Curve const& last = curve[n_curves - 1];
    n_sides = n_curves > 1 && last.degree == 1 && last.n_indices == 2 ? n_curves - 1 : n_curves;
    is_closed = meet(end_of(0, false), end_of(n_curves - 1, true));
    return Status::ok;
}

Status Section::find_chord(bool wants_leading_edge, Fault& fault) noexcept {
    if (has_chord && (has_leading_edge || !wants_leading_edge)) return Status::ok;
    if (!has_fixed_chord) {
        if (n_sides == 1 && is_periodic(curve[0])) {
            return fault.refuse(Status::bad_curve,
                                "a periodic section has no trailing edge, so the ends of the chord "
                                "must be given");
        }
        trailing_edge = 0.5 * (first_end().point() + last_end().point());
    }
    if (!has_fixed_chord || wants_leading_edge) HARMORPH_TRY(find_leading_edge(fault));
    if (!has_fixed_chord) leading_edge = leading_edge_place.point();
    has_leading_edge = !has_fixed_chord || wants_leading_edge;
    has_chord = square(chord()) > 0;
    if (has_chord) return Status::ok;
    return fault.refuse(Status::bad_curve, "the chord of the section has no length");
}

// Finds the sample that is farthest from the trailing edge, and then the maximum of the distance
// beside this sample.
Status Section::find_leading_edge(Fault& fault) noexcept {
    Real largest = 0, low = 0, high = 0;
    leading_edge_place = {};
    for_each_span(0, n_sides, [&](Index c, Index span, Real from, Real to) {
        // The span lies in the convex hull of its control points.
        Real bound = 0;
        for (Index k = span - curve[c].degree; k <= span; ++k)
            bound = max(bound, square(curve[c].point(k) - trailing_edge));
        if (bound * (1 + 8 * epsilon) < largest) return;
        Index const n = 8 * curve[c].degree;
        for (Index j = 0; j <= n; ++j) {
            CurvePlace const place{&curve[c], span, j == n ? to : from + (to - from) * j / n};
            Real const found = square(place.point() - trailing_edge);
            if (!(found > largest)) continue;
            largest = found;
            leading_edge_place = place;
            low = max(from, place.u - (to - from) / n);
            high = min(to, place.u + (to - from) / n);
        }
    });
    if (leading_edge_place.curve == nullptr)
        return fault.refuse(Status::bad_curve, "all points of the section are in the same place");
    leading_edge_is_smooth = refine_leading_edge(low, high);
    if (leading_edge_is_smooth) {
        Vec2 c[3];
        leading_edge_place.derivatives(2, c);
        leading_edge_is_smooth = square(c[1]) + dot(c[0] - trailing_edge, c[2]) < 0;
    }
    return Status::ok;
}

// Moves leading_edge_place to the parameter between low and high at which the slope of the squared
// distance is 0. If the place is a knot, the parameter may lie on the other side of the knot.
// Returns whether there is such a parameter.
bool Section::refine_leading_edge(Real low, Real high) noexcept {
    Curve const& side = *leading_edge_place.curve;
    auto const slope_in = [&](Index span, Real u) {
        Vec2 c[2];
        curve_point_in(side, span, u, 1, c);
        return dot(c[1], c[0] - trailing_edge);
    };
    auto const try_span = [&](Index span, Real from, Real to) {
        if (!(slope_in(span, from) >= 0 && slope_in(span, to) <= 0)) return false;
        leading_edge_place.span = span;
        leading_edge_place.u = sign_change(from, to, [&](Real u) { return slope_in(span, u); });
        return true;
    };
    Index const span = leading_edge_place.span;
    if (try_span(span, low, high)) return true;
    if (leading_edge_place.u == side.knots[span] && span > side.degree) {
        Index before = span - 1;
        while (before > side.degree && !(side.knots[before] < side.knots[before + 1])) --before;
        Real const end = side.knots[before + 1], width = end - side.knots[before];
        if (width > 0 && try_span(before, end - width / (8 * side.degree), end)) return true;
    }
    if (leading_edge_place.u == side.knots[span + 1] && span + 1 < side.n_indices) {
        Index after = span + 1;
        while (after + 1 < side.n_indices && !(side.knots[after] < side.knots[after + 1])) ++after;
        Real const begin = side.knots[after], width = side.knots[after + 1] - begin;
        if (width > 0 && try_span(after, begin, begin + width / (8 * side.degree))) return true;
    }
    return false;
}

void Section::pull_chord(ChordDerivative const& by,
                         ControlGradient const& gradient) const noexcept {
    if (has_fixed_chord || !gradient.wanted()) return;
    pull_leading_edge(by.leading_edge, 0, gradient);
    gradient.add(first_end(), 0.5 * by.trailing_edge);
    gradient.add(last_end(), 0.5 * by.trailing_edge);
}

// With the trailing edge T, the parameter u satisfies g = C' . (C - T) = 0, hence du = -(C' . (dC -
// dT) + (C - T) . dC') / g'. At a corner u does not change.
void Section::pull_leading_edge(Vec2 by_point, Real by_parameter,
                                ControlGradient const& gradient) const noexcept {
    if (!gradient.wanted()) return;
    if (!leading_edge_is_smooth) return gradient.add(leading_edge_place, by_point);
    Vec2 c[3];
    leading_edge_place.derivatives(2, c);
    Vec2 const away = c[0] - trailing_edge;
    Real const factor = -(by_parameter + dot(by_point, c[1])) / (square(c[1]) + dot(away, c[2]));
    Vec2 const by[2] = {by_point + factor * c[1], factor * away};
    gradient.add(leading_edge_place, 1, by);
    if (has_fixed_chord) return;
    gradient.add(first_end(), -0.5 * factor * c[1]);
    gradient.add(last_end(), -0.5 * factor * c[1]);
}

}  // namespace harmorph
