#include "bspline/section_stations.hpp"

#include "base/angle.hpp"

namespace harmorph {

bool runs_one_way(Curve const& curve, Index span, Vec2 along) noexcept {
    if (curve.weights != nullptr) return false;
    Real smallest = infinity, largest = -infinity;
    for (Index k = span - curve.degree + 1; k <= span; ++k) {
        Real const step = dot(curve.point(k) - curve.point(k - 1), along);
        smallest = min(smallest, step);
        largest = max(largest, step);
    }
    return smallest > 0 || largest < 0;
}

namespace {

// Returns where the span crosses the normal between two parameters. `ahead` is the distance from
// the normal; without weights, this is a polynomial, which takes less time.
template <class Ahead>
Real crossing(Curve const& curve, Index span, Real low, Real high, Ahead const& ahead, Vec2 through,
              Vec2 along) noexcept {
    if (curve.weights != nullptr) return sign_change(low, high, ahead);
    Vec2 by[max_degree + 1];
    curve_point_in(curve, span, low, curve.degree, by);
    Real coefficient[max_degree + 1], factor = 1;
    for (Index d = 0; d <= curve.degree; ++d) {
        if (d > 0) factor *= (high - low) / static_cast<Real>(d);
        coefficient[d] = factor * dot(d == 0 ? by[0] - through : by[d], along);
    }
    Real const t = sign_change(Real(0), Real(1), [&](Real at) {
        Real value = coefficient[curve.degree];
        for (Index d = curve.degree - 1; d >= 0; --d) value = value * at + coefficient[d];
        return value;
    });
    return low + t * (high - low);
}

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
        Index const n = runs_one_way(curve, span, along) ? 1 : 4 * curve.degree;
        Real u = low, before = ahead(low);
        for (Index j = 1; j <= n; ++j) {
            Real const next = j == n ? high : low + (high - low) * j / n, after = ahead(next);
            if ((before < 0) != (after < 0))
                include({&curve, span, crossing(curve, span, u, next, ahead, through, along)});
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

}  // namespace

Real station_value(Section const& section, StationValue which, Real at, Station& station) noexcept {
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

Real station_slope(Section const& section, StationValue which, Station const& station) noexcept {
    return dot(differentiate(section, which, station).point, section.chord());
}

Status measure_station(Section const& section, StationValue which, Real at, Station& station,
                       Fault& fault) noexcept {
    if (station_value(section, which, at, station) > -infinity) return Status::ok;
    return fault.refuse(
        Status::bad_curve,
        "the normal to the chord at station ~ meets the outline at fewer than two points", {}, {},
        at);
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

}  // namespace harmorph
