#include "bspline/section_clearance.hpp"

#include "base/elementary.hpp"
#include "base/vec2.hpp"
#include "bspline/projection.hpp"

namespace harmorph {
namespace {

// Returns whether the point is inside: the ray upwards from the point then crosses the outline an
// odd number of times. A sample exactly above or below the point counts as right of the ray, so
// that no crossing is counted twice.
bool is_inside(Section const& section, Vec2 q) noexcept {
    bool inside = false;
    auto const pass = [&](Vec2 a, Vec2 b, auto const& height) {
        if ((a.x < q.x) != (b.x < q.x) && height() > q.y) inside = !inside;
    };
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        Curve const& curve = section.curve[c];
        auto const at = [&](Real u) {
            Vec2 point;
            curve_point_in(curve, span, u, 0, &point);
            return point;
        };
        Index const n = 4 * curve.degree;
        Real u = low;
        Vec2 before = at(low);
        for (Index j = 1; j <= n; ++j) {
            Real const next = j == n ? high : low + (high - low) * j / n;
            Vec2 const after = at(next);
            pass(before, after,
                 [&] { return at(sign_change(u, next, [&](Real v) { return at(v).x - q.x; })).y; });
            u = next;
            before = after;
        }
    });
    Vec2 const a = section.end_of(section.n_curves - 1, true).point(),
               b = section.end_of(0, false).point();
    if (!section.is_closed)
        pass(a, b, [&] { return a.y + (q.x - a.x) / (b.x - a.x) * (b.y - a.y); });
    return inside;
}

}  // namespace

Clearance clearance_of_point(Section const& section, Vec2 q) noexcept {
    Clearance out;
    Real nearest = infinity;
    for (Index c = 0; c < section.n_curves; ++c) {
        Projection const foot = project(section.curve[c], q);
        if (!(foot.distance < nearest)) continue;
        nearest = foot.distance;
        out.nearest = {&section.curve[c], knot_span(section.curve[c], foot.u), foot.u};
    }
    Vec2 place = out.nearest.point();
    if (!section.is_closed) {
        Vec2 const a = section.end_of(section.n_curves - 1, true).point(),
                   b = section.end_of(0, false).point();
        Real const along = clamp(dot(q - a, b - a) / square(b - a), 0.0, 1.0);
        Vec2 const on_closing = a + along * (b - a);
        if (length(on_closing - q) < nearest) {
            nearest = length(on_closing - q);
            out.on_closing = true;
            out.along = along;
            place = on_closing;
        }
    }
    Real const sign = is_inside(section, q) ? 1 : -1;
    out.value = sign * nearest;
    out.towards = sign * direction(place - q);
    return out;
}

Clearance measure_clearance(Section const& section, Points polygon, Index n) noexcept {
    Clearance best;
    best.value = infinity;
    auto const try_point = [&](Vec2 q) {
        Clearance const found = clearance_of_point(section, q);
        if (found.value < best.value) best = found;
    };
    for (Index k = 0; k < n; ++k) try_point(polygon[k]);
    for (Index k = 0; k < (n > 2 ? n : n - 1); ++k) {
        Vec2 const a = polygon[k], side = polygon[(k + 1) % n] - a;
        if (!(square(side) > 0)) continue;  // the polygon repeats a point
        auto const try_foot = [&](Vec2 place) {
            Real const along = dot(place - a, side) / square(side);
            if (along > 0 && along < 1) try_point(a + along * side);
        };
        section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
            Curve const& curve = section.curve[c];
            auto const at = [&](Real u, Vec2* point) { curve_point_in(curve, span, u, 1, point); };
            auto const tilt = [&](Real u) {
                Vec2 point[2];
                at(u, point);
                return cross(point[1], side);
            };
            Vec2 point[2];
            at(low, point);
            try_foot(point[0]);  // the outline may have a corner at the beginning of a span
            Index const samples = 4 * curve.degree;
            Real u = low, before = tilt(low);
            for (Index j = 1; j <= samples; ++j) {
                Real const next = j == samples ? high : low + (high - low) * j / samples,
                           after = tilt(next);
                if ((before < 0) != (after < 0)) {
                    at(sign_change(u, next, tilt), point);
                    try_foot(point[0]);
                }
                u = next;
                before = after;
            }
        });
        try_foot(section.end_of(section.n_curves - 1, true).point());
    }
    return best;
}

void pull_clearance(Section const& section, Clearance const& clearance,
                    ControlGradient const& gradient) noexcept {
    if (!clearance.on_closing) return gradient.add(clearance.nearest, clearance.towards);
    gradient.add(section.end_of(section.n_curves - 1, true),
                 (1 - clearance.along) * clearance.towards);
    gradient.add(section.end_of(0, false), clearance.along * clearance.towards);
}

Clearance smooth_clearance(Section const& section, Points polygon, Index n, Real sharpness,
                           ControlGradient const& gradient) noexcept {
    SmoothMinimum found;
    found.sharpness = sharpness;
    Clearance best;
    for (Index k = 0; k < n; ++k) {
        Clearance const here = clearance_of_point(section, polygon[k]);
        if (k == 0 || here.value < best.value) best = here;
    }
    found.shift = best.value;
    for (Index k = 0; k < n; ++k) found.add(clearance_of_point(section, polygon[k]).value, k);
    for (Index k = 0; k < n && gradient.wanted(); ++k) {
        Clearance here = clearance_of_point(section, polygon[k]);
        here.towards = (found.weight(here.value) / found.sum) * here.towards;
        pull_clearance(section, here, gradient);
    }
    best.value = found.bound();
    return best;
}

namespace {

BodyDistance distance_at(Section const& to, bool from_is_other, CurvePlace const& place) noexcept {
    BodyDistance out;
    out.place_is_on_other = from_is_other;
    out.place = place;
    out.nearest = clearance_of_point(to, place.point());
    out.value = -out.nearest.value;  // a place outside of the other body has a positive distance
    return out;
}

// Calls visit(place, next place in the same span) for the places of an outline.
template <class Visit>
void for_each_place(Section const& section, Visit const& visit) noexcept {
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        Curve const& curve = section.curve[c];
        Index const n = 4 * curve.degree;
        auto const at = [&](Index j) { return j == n ? high : low + (high - low) * j / n; };
        for (Index j = 0; j < n; ++j)
            visit(CurvePlace{&curve, span, at(j)}, CurvePlace{&curve, span, at(j + 1)});
    });
}

// Searches for the smallest distance of the outline `from`: first at all places, then between those
// next to the best of them.
void search_distance(Section const& from, Section const& to, bool from_is_other,
                     BodyDistance& best) noexcept {
    BodyDistance coarse;
    for_each_place(from, [&](CurvePlace const& place, CurvePlace const&) {
        BodyDistance const found = distance_at(to, from_is_other, place);
        if (found.value < coarse.value) coarse = found;
    });
    if (coarse.value < best.value) best = coarse;
    Vec2 const centre = coarse.place.point();
    Real const touching = 1e-9 * from.extent();
    auto const slope_at = [&](CurvePlace place, Real u) {
        place.u = u;
        Vec2 point[2];
        place.derivatives(1, point);
        // The distance of a point q from the nearest point changes by `towards` . dq.
        return dot(clearance_of_point(to, point[0]).towards, point[1]);
    };
    for_each_place(from, [&](CurvePlace const& place, CurvePlace const& next) {
        if (length(place.point() - centre) > touching && length(next.point() - centre) > touching)
            return;
        if (!(slope_at(place, place.u) < 0) || !(slope_at(place, next.u) > 0)) return;
        CurvePlace lowest = place;
        lowest.u = sign_change(place.u, next.u, [&](Real u) { return slope_at(place, u); });
        BodyDistance const found = distance_at(to, from_is_other, lowest);
        if (found.value < best.value) best = found;
    });
}

}  // namespace

BodyDistance body_distance(Section const& section, Section const& other) noexcept {
    BodyDistance best;
    search_distance(section, other, false, best);
    search_distance(other, section, true, best);
    return best;
}

void pull_body_distance(Section const& section, Section const& other, BodyDistance const& distance,
                        Real weight, ControlGradient const& gradient) noexcept {
    // The value is minus the clearance, which changes by `towards` . d(nearest - place).
    gradient.add(distance.place, weight * distance.nearest.towards);
    Clearance nearest = distance.nearest;
    nearest.towards = -weight * nearest.towards;
    pull_clearance(distance.place_is_on_other ? section : other, nearest, gradient);
}

BodyDistance smooth_body_distance(Section const& section, Section const& other, Real sharpness,
                                  ControlGradient const& gradient) noexcept {
    SmoothMinimum found;
    found.sharpness = sharpness;
    BodyDistance best;
    auto const for_each = [&](auto const& visit) {
        for (Index side = 0; side < 2; ++side) {
            Section const &from = side == 0 ? section : other, &to = side == 0 ? other : section;
            for_each_place(from, [&](CurvePlace const& place, CurvePlace const&) {
                visit(distance_at(to, side == 1, place));
            });
        }
    };
    for_each([&](BodyDistance const& here) {
        if (here.value < best.value) best = here;
    });
    found.shift = best.value;
    for_each([&](BodyDistance const& here) { found.add(here.value, 0); });
    if (gradient.wanted()) {
        for_each([&](BodyDistance const& here) {
            Real const weight = found.weight(here.value) / found.sum;
            if (weight > 0) pull_body_distance(section, other, here, weight, gradient);
        });
    }
    best.value = found.bound();
    return best;
}

}  // namespace harmorph
