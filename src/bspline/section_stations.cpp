#include "bspline/section_stations.hpp"

#include "base/angle.hpp"
#include "base/smooth_minimum.hpp"

namespace harmorph {
namespace {

// Finds the highest and the lowest point of the outline on the normal to the chord through a point
// of the chord.
bool find_points(Section const& section, Vec2 through, CurvePlace& top,
                 CurvePlace& bottom) noexcept {
    Vec2 const along = section.chord(), up = left_of(along);
    Real highest = -infinity, lowest = infinity;
    auto const include = [&](CurvePlace const& place) {
        Real const height = dot(place.point() - through, up);
        if (height > highest) {
            highest = height;
            top = place;
        }
        if (height < lowest) {
            lowest = height;
            bottom = place;
        }
    };
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        Curve const& curve = section.curve[c];
        auto const ahead = [&](Real u) {
            Vec2 point;
            curve_point_in(curve, span, u, 0, &point);
            return dot(point - through, along);
        };
        // The span lies in the convex hull of its control points.
        Real first = infinity, last = -infinity;
        for (Index k = span - curve.degree; k <= span; ++k) {
            Real const at = dot(curve.point(k) - through, along);
            first = min(first, at);
            last = max(last, at);
        }
        if (first > 0 || last < 0) return;
        Index const n = 4 * curve.degree;
        Real u = low, before = ahead(low);
        for (Index j = 1; j <= n; ++j) {
            Real const next = j == n ? high : low + (high - low) * j / n, after = ahead(next);
            if ((before < 0) != (after < 0)) include({&curve, span, sign_change(u, next, ahead)});
            u = next;
            before = after;
        }
    });
    return highest > lowest;
}

// The derivatives of the value by the two points at fixed parameters, by the point of the chord
// line, and by the chord.
struct StationDerivative {
    Vec2 top[1], bottom[1], point, along;
    bool finite = true;
};

StationDerivative differentiate(Section const& section, StationValue which,
                                Station const& station) noexcept {
    StationDerivative out;
    Vec2 const along = section.chord();
    Real const size = length(along);
    Vec2 const normal = (1 / size) * left_of(along);
    bool const camber = which == StationValue::camber;
    Real const of_top = camber ? 0.5 : 1, of_bottom = camber ? 0.5 : -1;
    Vec2 offset;  // the value is offset . normal
    auto const pull = [&](CurvePlace const& place, Real share, Vec2& by_point) {
        Vec2 c[2];
        place.derivatives(1, c);
        Vec2 const from_chord = c[0] - station.point;
        offset = offset + share * from_chord;
        // At the parameter of the place, (C - point) . along = 0.
        Real const slope = dot(c[1], along), tangent = length(c[1]);
        out.finite = out.finite && abs(slope) > 1e-9 * tangent * size;
        Real const factor = -share * dot(c[1], normal) / slope;
        by_point = share * normal + factor * along;
        out.point = out.point - factor * along;
        out.along = out.along + factor * from_chord;
    };
    pull(station.top, of_top, out.top[0]);
    pull(station.bottom, of_bottom, out.bottom[0]);
    if (camber) out.point = out.point - normal;
    out.along =
        out.along + (1 / size) * (Vec2{offset.y, -offset.x} - (dot(offset, normal) / size) * along);
    return out;
}

Real value_at(Section const& section, StationValue which, Real at, Station& station) noexcept {
    Vec2 const along = section.chord();
    station.at = at;
    station.point = section.leading_edge + at * along;
    if (!find_points(section, station.point, station.top, station.bottom))
        return station.value = -infinity;
    Vec2 const normal = (1 / length(along)) * left_of(along);
    Vec2 const top = station.top.point(), bottom = station.bottom.point();
    if (which == StationValue::thickness) return station.value = dot(top - bottom, normal);
    return station.value = 0.5 * dot(top - station.point + bottom - station.point, normal);
}

// Returns the derivative of the value along the chord, per length of the chord.
Real slope_at(Section const& section, StationValue which, Station const& station) noexcept {
    return dot(differentiate(section, which, station).point, section.chord());
}

}  // namespace

Status measure_station(Section const& section, StationValue which, Real at, Station& station,
                       Fault& fault) noexcept {
    if (value_at(section, which, at, station) > -infinity) return Status::ok;
    return fault.refuse(
        Status::bad_curve,
        "the normal to the chord at station ~ meets the outline at fewer than two points", {}, {},
        at);
}

namespace {

// The stations that a search tries, and the sign of the value that is made largest.
struct StationSearch {
    static constexpr Index n = 128;
    bool is_whole =
        true;  // all stations; otherwise those from first to last, for the smallest value
    Real first = 0, last = 1;

    // The stations t^2 (3 - 2 t) are dense at both ends, where slopes are steep.
    Real place(Index k) const noexcept {
        Real const t = static_cast<Real>(k) / n;
        return is_whole ? t * t * (3 - 2 * t) : first + (last - first) * t;
    }
    Index first_try() const noexcept { return is_whole ? 1 : 0; }
    Index last_try() const noexcept { return is_whole ? n - 1 : n; }
    Real sign(StationValue which, Real value) const noexcept {
        if (!is_whole) return -1;
        return which == StationValue::camber && value < 0 ? -1 : 1;
    }
};

Status search_stations(Section const& section, StationValue which, StationSearch const& search,
                       ExtremeStation& extreme, Fault& fault) noexcept {
    Station& station = extreme.before;
    Index best = none;
    Real largest = -infinity, sign = 1;
    for (Index k = search.first_try(); k <= search.last_try(); ++k) {
        Real const value = value_at(section, which, search.place(k), station);
        if (value == -infinity) continue;
        Real const sign_here = search.sign(which, value);
        if (!(sign_here * value > largest)) continue;
        largest = sign_here * value;
        best = k;
        sign = sign_here;
    }
    if (best == none) {
        return fault.refuse(Status::bad_curve,
                            "no normal to the chord meets the outline at two points");
    }
    // The rise is 0 where the normal does not meet the outline.
    auto const rise = [&](Real at) {
        Station there;
        bool const found = value_at(section, which, at, there) > -infinity;
        return found ? sign * slope_at(section, which, there) : 0;
    };
    Neighbours at = {search.place(best), search.place(best)};
    Real const low = search.place(max(best - 1, search.first_try())),
               high = search.place(min(best + 1, search.last_try()));
    if (rise(low) > 0 && rise(high) < 0) at = sign_change_between(low, high, rise);
    value_at(section, which, at.low, station);
    extreme.behind = station;
    if (!(at.low < at.high) || !(value_at(section, which, at.high, extreme.behind) > -infinity))
        return Status::ok;
    Real const rise_before = rise(at.low), fall_behind = -rise(at.high);
    if (rise_before + fall_behind > 0)
        extreme.weight_before = fall_behind / (rise_before + fall_behind);
    return Status::ok;
}

}  // namespace

Status measure_extreme(Section const& section, StationValue which, ExtremeStation& extreme,
                       Fault& fault) noexcept {
    return search_stations(section, which, {}, extreme, fault);
}

Status measure_thinnest(Section const& section, Real first, Real last, ExtremeStation& extreme,
                        Fault& fault) noexcept {
    return search_stations(section, StationValue::thickness, {false, first, last}, extreme, fault);
}

Status measure_smooth_thinnest(Section const& section, Real first, Real last, Real sharpness,
                               Station& thinnest, Real& bound, ControlGradient const& gradient,
                               Fault& fault) noexcept {
    constexpr Index n = 64;
    constexpr StationValue which = StationValue::thickness;
    auto const at = [&](Index k) { return first + (last - first) * k / n; };
    SmoothMinimum found;
    found.sharpness = sharpness;
    Station station;
    for (Index k = 0; k <= n; ++k) {
        HARMORPH_TRY(measure_station(section, which, at(k), station, fault));
        found.note(station.value, k);
    }
    found.shift = found.least;
    for (Index k = 0; k <= n; ++k) found.add(value_at(section, which, at(k), station), k);
    for (Index k = 0; k <= n; ++k) {
        Real const weight = found.weight(value_at(section, which, at(k), station)) / found.sum;
        if (weight > 0)
            HARMORPH_TRY(pull_station(section, which, station, weight, gradient, fault));
    }
    value_at(section, which, at(found.item), thinnest);
    bound = found.bound();
    return Status::ok;
}

Status pull_station(Section const& section, StationValue which, Station const& station, Real weight,
                    ControlGradient const& gradient, Fault& fault) noexcept {
    StationDerivative const by = differentiate(section, which, station);
    if (!by.finite) {
        return fault.refuse(Status::bad_curve,
                            "the derivative at station ~ is infinite, because the outline is "
                            "parallel to the normal of the chord",
                            {}, {}, station.at);
    }
    gradient.add(station.top, weight * by.top[0]);
    gradient.add(station.bottom, weight * by.bottom[0]);
    section.pull_chord({weight * ((1 - station.at) * by.point - by.along),
                        weight * (station.at * by.point + by.along)},
                       gradient);
    return Status::ok;
}

Status pull_extreme(Section const& section, StationValue which, ExtremeStation const& extreme,
                    ControlGradient const& gradient, Fault& fault) noexcept {
    Real const weight = extreme.weight_before;
    HARMORPH_TRY(pull_station(section, which, extreme.before, weight, gradient, fault));
    if (weight == 1) return Status::ok;
    return pull_station(section, which, extreme.behind, 1 - weight, gradient, fault);
}

}  // namespace harmorph
