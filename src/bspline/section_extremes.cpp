#include "bspline/section_extremes.hpp"

#include "base/elementary.hpp"
#include "base/vec2.hpp"

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
    Real coefficient[max_degree + 1] = {}, factor = 1;
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

namespace {

// Stations at which the extremes are looked for. The stations t^2 (3 - 2 t) are dense at both ends,
// where slopes are steep.
constexpr Index n_stations = 128;

Real station_place(Index k) noexcept {
    Real const t = static_cast<Real>(k) / n_stations;
    return t * t * (3 - 2 * t);
}

// Finds the heights of the outline above and below the chord at all stations between the ends of
// the chord, span by span. In a span of a curve without weights, the distance along the chord and
// the height are polynomials of the parameter.
class HeightScan {
public:
    // Returns false if a curve is rational; nothing is known then.
    bool run(Section const& section) noexcept {
        for (Index c = 0; c < section.n_curves; ++c)
            if (section.curve[c].weights != nullptr) return false;
        for (Index k = 0; k <= n_stations; ++k) {
            highest_[k] = -infinity;
            lowest_[k] = infinity;
        }
        Vec2 const along = section.chord(), up = left_of(along);
        Real const scale = 1 / square(along);
        section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
            Curve const& curve = section.curve[c];
            Vec2 by[max_degree + 1];
            curve_point_in(curve, span, low, curve.degree, by);
            degree_ = curve.degree;
            Real factor = scale;
            for (Index d = 0; d <= degree_; ++d) {
                if (d > 0) factor *= (high - low) / static_cast<Real>(d);
                Vec2 const term = d == 0 ? by[0] - section.leading_edge : by[d];
                ahead_[d] = factor * dot(term, along);
                height_[d] = factor * dot(term, up);
            }
            Index const n = runs_one_way(curve, span, along) ? 1 : 4 * curve.degree;
            for (Index j = 0; j < n; ++j)
                take(static_cast<Real>(j) / n, static_cast<Real>(j + 1) / n);
        });
        return true;
    }

    // Returns the value at station k in chords, or minus infinity.
    Real value(Index k, StationValue which) const noexcept {
        if (!(highest_[k] > lowest_[k])) return -infinity;
        return which == StationValue::thickness ? highest_[k] - lowest_[k]
                                                : 0.5 * (highest_[k] + lowest_[k]);
    }

private:
    Real at(Real const* polynomial, Real t) const noexcept {
        Real value = polynomial[degree_];
        for (Index d = degree_ - 1; d >= 0; --d) value = value * t + polynomial[d];
        return value;
    }

    // Takes the heights at the stations between the places of t = first and t = last.
    void take(Real first, Real last) noexcept {
        Real const a = at(ahead_, first), b = at(ahead_, last);
        Real const low = min(a, b), high = max(a, b);
        Index k = 0, end = n_stations;
        while (k < end) {  // the first station that is not below `low`
            Index const middle = k + (end - k) / 2;
            if (station_place(middle) < low) k = middle + 1;
            else end = middle;
        }
        for (; k <= n_stations && station_place(k) <= high; ++k) {
            Real const target = station_place(k);
            Real t0 = first, t1 = last, f0 = a - target, f1 = b - target, t = first;
            for (Index round = 0; round < max_rounds; ++round) {  // false position, or bisection
                bool const halves = round % 4 == 3 || f0 == f1;
                t = halves ? 0.5 * (t0 + t1) : t0 + (t1 - t0) * (f0 / (f0 - f1));
                Real const f = at(ahead_, t) - target;
                if (abs(f) < accuracy) break;
                bool const is_before = (f < 0) == (a < b);
                (is_before ? t0 : t1) = t;
                (is_before ? f0 : f1) = f;
            }
            Real const height = at(height_, t);
            highest_[k] = max(highest_[k], height);
            lowest_[k] = min(lowest_[k], height);
        }
    }

    static constexpr Index max_rounds = 60;
    static constexpr Real accuracy = 1e-9;  // in chords

    Real highest_[n_stations + 1], lowest_[n_stations + 1];
    Real ahead_[max_degree + 1], height_[max_degree + 1];  // coefficients, in chords
    Index degree_ = 0;
};

// The stations that a search tries, and the sign of the value that is made largest.
struct StationSearch {
    static constexpr Index n = n_stations;
    // If true, all stations are tried; otherwise those from first to last, for the smallest value.
    bool is_whole = true;
    Real first = 0, last = 1;

    Real place(Index k) const noexcept {
        return is_whole ? station_place(k) : first + (last - first) * static_cast<Real>(k) / n;
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
    HeightScan scan;
    bool const is_scanned = search.is_whole && scan.run(section);
    Index best = none;
    Real largest = -infinity, sign = 1;
    for (Index k = search.first_try(); k <= search.last_try(); ++k) {
        Real const value = is_scanned ? scan.value(k, which)
                                      : station_value(section, which, search.place(k), station);
        if (value == -infinity) continue;
        Real const sign_here = search.sign(which, value);
        if (!(sign_here * value > largest)) continue;
        largest = sign_here * value;
        best = k;
        sign = sign_here;
    }
    auto const refuse = [&] {
        return fault.refuse(Status::bad_curve,
                            "no normal to the chord meets the outline at two points");
    };
    if (best == none) return refuse();
    // The rise is 0 where the normal does not meet the outline.
    auto const rise = [&](Real at) {
        Station there;
        bool const found = station_value(section, which, at, there) > -infinity;
        return found ? sign * station_slope(section, which, there) : 0;
    };
    Neighbours at = {search.place(best), search.place(best)};
    Real const low = search.place(max(best - 1, search.first_try())),
               high = search.place(min(best + 1, search.last_try()));
    if (rise(low) > 0 && rise(high) < 0) at = sign_change_between(low, high, rise);
    // Rounding may give an outline without area a height in the scan.
    if (!(station_value(section, which, at.low, station) > -infinity)) return refuse();
    extreme.behind = station;
    if (!(at.low < at.high) ||
        !(station_value(section, which, at.high, extreme.behind) > -infinity))
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
    found.shift = found.smallest;
    for (Index k = 0; k <= n; ++k) found.add(station_value(section, which, at(k), station), k);
    for (Index k = 0; k <= n; ++k) {
        Real const weight = found.weight(station_value(section, which, at(k), station)) / found.sum;
        if (weight > 0)
            HARMORPH_TRY(pull_station(section, which, station, weight, gradient, fault));
    }
    station_value(section, which, at(found.item), thinnest);
    bound = found.bound();
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
