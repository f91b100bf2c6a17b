#include "bspline/section_extremes.hpp"

#include "base/angle.hpp"
#include "base/smooth_minimum.hpp"

namespace harmorph {
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
    found.shift = found.least;
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
