#include "bspline/section_distance.hpp"

#include "base/smooth_minimum.hpp"

namespace harmorph {
namespace {

BodyDistance distance_at(Section const& from, Section const& to, bool from_is_other,
                         CurvePlace const& place) noexcept {
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
        BodyDistance const found = distance_at(from, to, from_is_other, place);
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
        BodyDistance const found = distance_at(from, to, from_is_other, lowest);
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
                visit(distance_at(from, to, side == 1, place));
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
