#include "bspline/section_measures.hpp"

#include "base/vec2.hpp"
#include "bspline/quadrature.hpp"
#include "bspline/section_clearance.hpp"
#include "bspline/section_extremes.hpp"

namespace harmorph {
namespace {

// The integrals of 1, x, y, y^2, x^2 and x y over the area are computed along the outline, as the
// integral of (x dy - y dx) / 2 for the area. The origin is a point near the section, so that
// little cancels.
enum : Index { n_integrals = 6 };
using Integrals = Sums<n_integrals>;

Integrals integrand(Vec2 p, Vec2 d) noexcept {
    return {{0.5 * cross(p, d), 0.5 * p.x * p.x * d.y, -0.5 * p.y * p.y * d.x,
             -p.y * p.y * p.y * d.x / 3, p.x * p.x * p.x * d.y / 3, 0.5 * p.x * p.x * p.y * d.y}};
}

// Computes the derivatives of the sum of by * integrand by the point p and by the derivative d.
void differentiate(Integrals const& by, Vec2 p, Vec2 d, Vec2& by_point,
                   Vec2& by_derivative) noexcept {
    const Real* const w = by.value;
    by_point = {
        0.5 * w[0] * d.y + w[1] * p.x * d.y + w[4] * p.x * p.x * d.y + w[5] * p.x * p.y * d.y,
        -0.5 * w[0] * d.x - w[2] * p.y * d.x - w[3] * p.y * p.y * d.x +
            0.5 * w[5] * p.x * p.x * d.y};
    by_derivative = {-0.5 * w[0] * p.y - 0.5 * w[2] * p.y * p.y - w[3] * p.y * p.y * p.y / 3,
                     0.5 * w[0] * p.x + 0.5 * w[1] * p.x * p.x + w[4] * p.x * p.x * p.x / 3 +
                         0.5 * w[5] * p.x * p.x * p.y};
}

Vec2 reference_of(Section const& section) noexcept { return section.curve[0].point(0); }

// Calls body(low, high, curve, span) for subintervals of spans on which Gauss' rule is exact to
// rounding.
template <class Body>
void for_each_interval(Section const& section, Body const& body) noexcept {
    Vec2 const reference = reference_of(section);
    Real const extent = section.extent();
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        if (section.curve[c].weights == nullptr) return body(low, high, c, span);
        auto const at = [&](Real u) {
            Vec2 point[2];
            curve_point_in(section.curve[c], span, u, 1, point);
            Integrals const found = integrand(point[0] - reference, point[1]);
            Real const size = extent * length(point[1]);
            Sums<2 * n_integrals> out;
            for (Index i = 0; i < n_integrals; ++i) {
                out.value[i] = found.value[i];
                out.value[n_integrals + i] = i == 0  ? size
                                             : i < 3 ? size * extent
                                                     : size * extent * extent;
            }
            return out;
        };
        for_converged<2 * n_integrals>(low, high, at, [&](Real a, Real b) { body(a, b, c, span); });
    });
}

// The straight line from the last end of the outline to the first end. Its length is 0 if the
// outline is closed.
struct Closing {
    CurvePlace from, to;
    Vec2 a, b;

    explicit Closing(Section const& section) noexcept
        : from(section.end_of(section.n_curves - 1, true)),
          to(section.end_of(0, false)),
          a(from.point()),
          b(to.point()) {}
};

Integrals integrals_of(Section const& section) noexcept {
    Vec2 const reference = reference_of(section);
    Integrals sum;
    auto const add = [&](Vec2 p, Vec2 d, Real weight) {
        Integrals const at = integrand(p - reference, d);
        for (Index i = 0; i < n_integrals; ++i) sum.value[i] += weight * at.value[i];
    };
    for_each_interval(section, [&](Real low, Real high, Index c, Index span) {
        Real const sense = section.backwards[c] ? -1 : 1;
        Gauss10::for_each(low, high, [&](Real u, Real weight) {
            Vec2 point[2];
            curve_point_in(section.curve[c], span, u, 1, point);
            add(point[0], point[1], sense * weight);
        });
    });
    Closing const closing(section);
    Gauss10::for_each(0, 1, [&](Real t, Real weight) {
        add(closing.a + t * (closing.b - closing.a), closing.b - closing.a, weight);
    });
    return sum;
}

}  // namespace

Status area_moments(Section& section, AreaMoments& moments, Fault& fault) noexcept {
    Integrals sum = integrals_of(section);
    Real const extent = section.extent();
    if (!(abs(sum.value[0]) > 64 * epsilon * extent * extent)) {
        return fault.refuse(Status::bad_curve,
                            "the section encloses no area: the integral along the outline is ~", {},
                            {}, sum.value[0]);
    }
    section.sign = sum.value[0] < 0 ? -1 : 1;
    for (Real& value : sum.value) value *= section.sign;
    Real const area = sum.value[0];
    Vec2 const c = {sum.value[1] / area, sum.value[2] / area};  // relative to the reference
    moments.area = area;
    moments.centroid = reference_of(section) + c;
    moments.xx = sum.value[3] - area * c.y * c.y;
    moments.yy = sum.value[4] - area * c.x * c.x;
    moments.xy = sum.value[5] - area * c.x * c.y;
    return Status::ok;
}

void pull_area_moments(Section const& section, AreaMoments const& moments, AreaDerivative const& by,
                       ControlGradient const& gradient) noexcept {
    if (!gradient.wanted()) return;
    Vec2 const reference = reference_of(section), c = moments.centroid - reference;
    Real const area = moments.area;
    // With the integrals I0 to I5, c = (I1, I2) / I0, xx = I3 - I2^2 / I0, and so on.
    Integrals w{{by.area - dot(by.centroid, c) / area + by.xx * c.y * c.y + by.yy * c.x * c.x +
                     by.xy * c.x * c.y,
                 by.centroid.x / area - 2 * by.yy * c.x - by.xy * c.y,
                 by.centroid.y / area - 2 * by.xx * c.y - by.xy * c.x, by.xx, by.yy, by.xy}};
    for (Real& value : w.value) value *= section.sign;
    for_each_interval(section, [&](Real low, Real high, Index number, Index span) {
        Real const sense = section.backwards[number] ? -1 : 1;
        Gauss10::for_each(low, high, [&](Real u, Real weight) {
            CurvePlace const place{&section.curve[number], span, u};
            Vec2 point[2], out[2];
            place.derivatives(1, point);
            differentiate(w, point[0] - reference, point[1], out[0], out[1]);
            out[0] = sense * weight * out[0];
            out[1] = sense * weight * out[1];
            gradient.add(place, 1, out);
        });
    });
    Closing const closing(section);
    Gauss10::for_each(0, 1, [&](Real t, Real weight) {
        Vec2 const along = closing.b - closing.a;
        Vec2 by_point, by_derivative;
        differentiate(w, closing.a + t * along - reference, along, by_point, by_derivative);
        gradient.add(closing.from, weight * ((1 - t) * by_point - by_derivative));
        gradient.add(closing.to, weight * (t * by_point + by_derivative));
    });
}

namespace {

constexpr Vec2 right_of(Vec2 v) noexcept { return {v.y, -v.x}; }

// Computes the curvature k = C' x C'' / |C'|^3 and its derivative by the parameter from the
// derivatives c[1], c[2], c[3] of a curve, and the derivatives of both numbers by C', C'' and C'''.
// The formulas use t = C' / |C'|, a = C'' / |C'|^2 and b = C''' / |C'|^3, so that no power of the
// speed |C'| overflows. If the speed is 0 or nearly 0, the curvature does not exist, and all
// numbers are 0. Within the bounds below no measure overflows.
struct Curvature {
    bool exists = false;
    Real value = 0, slope = 0, speed = 0;
    Vec2 value_by[3], slope_by[4];

    explicit Curvature(const Vec2* c) noexcept {
        Real const size = max(abs(c[1].x), abs(c[1].y));
        if (!(size > 1e-30 && size < 1e60)) return;
        Real const found = length(c[1]), per = 1 / found;
        if (!is_at_most(c[2], 1e40 * found * found) ||
            !is_at_most(c[3], 1e90 * found * found * found))
            return;
        Vec2 const t = per * c[1], a = per * (per * c[2]), b = per * (per * (per * c[3]));
        Real const d = dot(t, a), x = cross(t, a), y = cross(t, b);
        if (!(abs(y) + 3 * abs(x * d) <= 1e100 * per)) return;
        exists = true;
        speed = found;
        value = x;
        slope = speed * (y - 3 * x * d);
        // The derivative of C' x C'' by C' is C'' rotated right, and by C'' it is C' rotated left.
        Vec2 const by_second = per * (per * left_of(t));
        value_by[1] = per * (right_of(a) - 3 * x * t);
        value_by[2] = by_second;
        slope_by[1] = right_of(b) - 3 * y * t - 3 * (d * right_of(a) + x * a) + 15 * x * d * t;
        slope_by[2] = (-3 * per) * (d * left_of(t) + x * t);
        slope_by[3] = by_second;
    }

private:
    static bool is_at_most(Vec2 derivative, Real size) noexcept {
        return abs(derivative.x) <= size && abs(derivative.y) <= size;
    }
};

Curvature curvature_at(CurvePlace const& place) noexcept {
    Vec2 c[4];
    place.derivatives(3, c);
    return Curvature(c);
}

Status refuse_zero_speed(Section const& section, CurvePlace const& place, Fault& fault) noexcept {
    return fault.refuse(
        Status::bad_curve,
        "curve @ has no curvature at parameter ~, because its derivative is 0 there", {},
        curve_item(section.first_curve + static_cast<Index>(place.curve - section.curve)), place.u);
}

Status check_speed(Section const& section, Fault& fault) noexcept {
    Status status = Status::ok;
    Real const smallest = 1e-12 * section.extent();
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        Index const n = 2 * section.curve[c].degree;
        for (Index j = 0; j <= n && !failed(status); ++j) {
            Vec2 point[2];
            curve_point_in(section.curve[c], span, low + (high - low) * j / n, 1, point);
            if (length(point[1]) * (high - low) > smallest) continue;
            status = refuse_zero_speed(
                section, {&section.curve[c], span, low + (high - low) * j / n}, fault);
        }
    });
    return status;
}

}  // namespace

Status radius_at_leading_edge(Section const& section, Real& radius, ControlGradient const& gradient,
                              Fault& fault) noexcept {
    Curvature const at = curvature_at(section.leading_edge_place);
    Real const bend =
        section.sign *
        (section.backwards[section.leading_edge_place.curve - section.curve] ? -1 : 1) * at.value;
    if (!section.leading_edge_is_smooth || !at.exists || !(abs(bend) * section.extent() > 1e-12)) {
        return fault.refuse(
            Status::bad_curve,
            "the leading edge is a corner or straight, so it has no radius of curvature");
    }
    radius = 1 / bend;
    Real const by_value = -radius * radius * bend / at.value;  // bend / at.value is the sign
    Vec2 const by[3] = {{}, by_value * at.value_by[1], by_value * at.value_by[2]};
    gradient.add(section.leading_edge_place, 2, by);
    section.pull_leading_edge({}, by_value * at.slope, gradient);
    return Status::ok;
}

Status smallest_radius(Section const& section, SmallestRadius& bend,
                       ControlGradient const& gradient, Fault& fault) noexcept {
    HARMORPH_TRY(check_speed(section, fault));
    Real largest = 0;
    CurvePlace zero_speed;  // a place without curvature, if there is one
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        Curve const& curve = section.curve[c];
        auto const include = [&](Real u) {
            CurvePlace const place{&curve, span, u};
            Curvature const at = curvature_at(place);
            if (!at.exists) zero_speed = place;
            if (abs(at.value) <= largest) return;
            largest = abs(at.value);
            bend.place = place;
        };
        Index const n = 8 * curve.degree;
        // The slope of half the squared curvature.
        auto const slope = [&](Real u) {
            Curvature const at = curvature_at({&curve, span, u});
            return at.value * at.slope;
        };
        Real u = low, before = slope(low);
        include(low);
        for (Index j = 1; j <= n; ++j) {
            Real const next = j == n ? high : low + (high - low) * j / n, after = slope(next);
            include(next);
            if (before > 0 && after < 0) include(sign_change(u, next, slope));
            u = next;
            before = after;
        }
    });
    if (zero_speed.curve != nullptr) return refuse_zero_speed(section, zero_speed, fault);
    if (!(largest * section.extent() > 1e-12)) {
        return fault.refuse(Status::bad_curve,
                            "the outline is straight, so it has no radius of curvature");
    }
    bend.radius = 1 / largest;
    Curvature const at = curvature_at(bend.place);
    Real const by_value = -bend.radius * bend.radius * (at.value < 0 ? -1 : 1);
    Vec2 const by[3] = {{}, by_value * at.value_by[1], by_value * at.value_by[2]};
    gradient.add(bend.place, 2, by);
    return Status::ok;
}

Status curvature_variation(Section const& section, Real& variation, ControlGradient const& gradient,
                           Fault& fault) noexcept {
    for (Index c = 0; c < section.n_sides; ++c) {
        if (section.curve[c].degree > 1) continue;
        return fault.refuse(Status::bad_curve,
                            "curve @ of the section has degree 1, so it has no curvature", {},
                            curve_item(section.first_curve + c));
    }
    HARMORPH_TRY(check_speed(section, fault));
    variation = 0;
    CurvePlace zero_speed;
    section.for_each_span(0, section.n_sides, [&](Index c, Index span, Real low, Real high) {
        auto const integrand = [&](Real u) {
            CurvePlace const place{&section.curve[c], span, u};
            Curvature const at = curvature_at(place);
            if (!at.exists) {
                zero_speed = place;
                return Sums<2>{};
            }
            Real const square_value = at.value * at.value;
            return Sums<2>{
                {at.slope * at.slope / at.speed, square_value * square_value * at.speed}};
        };
        for_converged<2>(low, high, integrand, [&](Real a, Real b) {
            Gauss10::for_each(a, b, [&](Real u, Real weight) {
                CurvePlace const place{&section.curve[c], span, u};
                Vec2 point[4];
                place.derivatives(3, point);
                Curvature const at(point);
                if (!at.exists) {
                    zero_speed = place;
                    return;
                }
                variation += weight * at.slope * at.slope / at.speed;
                Real const by_slope = 2 * weight * at.slope / at.speed;
                Real const by_square_speed =
                    -0.5 * weight * at.slope * at.slope / (at.speed * at.speed * at.speed);
                Vec2 const by[4] = {{},
                                    by_slope * at.slope_by[1] + 2 * by_square_speed * point[1],
                                    by_slope * at.slope_by[2],
                                    by_slope * at.slope_by[3]};
                gradient.add(place, 3, by);
            });
        });
    });
    if (zero_speed.curve != nullptr) return refuse_zero_speed(section, zero_speed, fault);
    return Status::ok;
}

namespace {

Status measure_area(Section& section, QuantityKind kind, ControlGradient const& gradient,
                    Measured& measured, Fault& fault) noexcept {
    AreaMoments found;
    AreaDerivative by;
    HARMORPH_TRY(area_moments(section, found, fault));
    auto const take = [&](Real value, Real& derivative) {
        measured.value = value;
        derivative = 1;
    };
    switch (kind) {
        case QuantityKind::area: take(found.area, by.area); break;
        case QuantityKind::centroid_x: take(found.centroid.x, by.centroid.x); break;
        case QuantityKind::centroid_y: take(found.centroid.y, by.centroid.y); break;
        case QuantityKind::moment_xx: take(found.xx, by.xx); break;
        case QuantityKind::moment_yy: take(found.yy, by.yy); break;
        default: take(found.xy, by.xy); break;
    }
    measured.at = found.centroid;
    pull_area_moments(section, found, by, gradient);
    return Status::ok;
}

Status measure_chord(Section& section, ControlGradient const& gradient, Measured& measured,
                     Fault& fault) noexcept {
    HARMORPH_TRY(section.find_chord(false, fault));
    measured = {length(section.chord()), section.leading_edge};
    Vec2 const along = direction(section.chord());
    section.pull_chord({-1 * along, along}, gradient);
    return Status::ok;
}

Status measure_stations(Section& section, Quantity const& quantity, ControlGradient const& gradient,
                        Measured& measured, Fault& fault) noexcept {
    bool const extreme =
        quantity.kind == QuantityKind::max_thickness || quantity.kind == QuantityKind::max_camber;
    bool const thickness =
        quantity.kind == QuantityKind::max_thickness || quantity.kind == QuantityKind::thickness;
    StationValue const which = thickness ? StationValue::thickness : StationValue::camber;
    HARMORPH_TRY(section.find_chord(false, fault));
    if (extreme) {
        ExtremeStation found;
        HARMORPH_TRY(measure_extreme(section, which, found, fault));
        measured = {found.before.value, found.before.point};
        return pull_extreme(section, which, found, gradient, fault);
    }
    Station found;
    HARMORPH_TRY(measure_station(section, which, quantity.station, found, fault));
    measured = {found.value, found.point};
    return pull_station(section, which, found, 1, gradient, fault);
}

Status measure_twist(Section& section, ControlGradient const& gradient, Measured& measured,
                     Fault& fault) noexcept {
    HARMORPH_TRY(section.find_chord(false, fault));
    Vec2 const along = section.chord();
    measured = {in_degrees(angle_of(along)), section.leading_edge};
    Vec2 const by_along = in_degrees(1 / square(along)) * left_of(along);
    section.pull_chord({-1 * by_along, by_along}, gradient);
    return Status::ok;
}

Status measure_min_thickness(Section& section, Quantity const& quantity,
                             ControlGradient const& gradient, Measured& measured,
                             Fault& fault) noexcept {
    HARMORPH_TRY(section.find_chord(false, fault));
    if (quantity.sharpness > 0) {
        Station thinnest;
        HARMORPH_TRY(measure_smooth_thinnest(section, quantity.station, quantity.last_station,
                                             quantity.sharpness, thinnest, measured.value, gradient,
                                             fault));
        measured.at = thinnest.point;
        return Status::ok;
    }
    ExtremeStation found;
    HARMORPH_TRY(measure_thinnest(section, quantity.station, quantity.last_station, found, fault));
    measured = {found.before.value, found.before.point};
    return pull_extreme(section, StationValue::thickness, found, gradient, fault);
}

void measure_distance(Section const& section, Quantity const& quantity,
                      ControlGradient const& gradient, Measured& measured) noexcept {
    Section const& other = *quantity.other;
    BodyDistance found;
    if (quantity.sharpness > 0) {
        found = smooth_body_distance(section, other, quantity.sharpness, gradient);
    } else {
        found = body_distance(section, other);
        pull_body_distance(section, other, found, 1, gradient);
    }
    measured = {found.value, found.place.point()};
}

Status measure_leading_edge(Section& section, ControlGradient const& gradient, Measured& measured,
                            Fault& fault) noexcept {
    AreaMoments moments;
    HARMORPH_TRY(area_moments(section, moments, fault));  // sets the orientation of the section
    HARMORPH_TRY(section.find_chord(true, fault));
    measured.at = section.leading_edge_place.point();
    return radius_at_leading_edge(section, measured.value, gradient, fault);
}

// Measures the angle between the tangents at both ends of the outline, through the inside of the
// section. The range is -90 to 270 degrees: a smooth outline has 180 degrees, and rounding cannot
// change this to -180.
Status measure_trailing_edge_angle(Section& section, ControlGradient const& gradient,
                                   Measured& measured, Fault& fault) noexcept {
    AreaMoments moments;
    HARMORPH_TRY(area_moments(section, moments, fault));
    CurvePlace const first = section.first_end(), last = section.last_end();
    Vec2 a[2], b[2];
    first.derivatives(1, a);
    last.derivatives(1, b);
    bool const backwards_first = section.backwards[0],
               backwards_last = section.backwards[section.n_sides - 1];
    Vec2 const from = (backwards_first ? -1.0 : 1.0) * a[1],
               to = (backwards_last ? 1.0 : -1.0) * b[1];
    if (!(square(from) > 0) || !(square(to) > 0)) {
        return fault.refuse(
            Status::bad_curve,
            "the angle of the trailing edge is not defined, because the derivative of the curve is "
            "0 there");
    }
    Real const sign = section.sign * in_degrees(1);
    Real const angle = sign * angle_of(rotation_between(from, to));
    measured = {angle < -90 ? angle + 360 : angle, a[0]};
    Vec2 const by_first[2] = {{}, (backwards_first ? 1 : -1) * sign / square(from) * left_of(from)};
    Vec2 const by_last[2] = {{}, (backwards_last ? 1 : -1) * sign / square(to) * left_of(to)};
    gradient.add(first, 1, by_first);
    gradient.add(last, 1, by_last);
    return Status::ok;
}

Status measure_trailing_edge_gap(Section& section, ControlGradient const& gradient,
                                 Measured& measured, Fault& fault) noexcept {
    AreaMoments moments;
    HARMORPH_TRY(area_moments(section, moments, fault));
    HARMORPH_TRY(section.find_chord(false, fault));
    // If the outline is counter-clockwise, the first end is the upper one.
    CurvePlace const first = section.first_end(), last = section.last_end();
    Vec2 const along = section.chord(), gap = section.sign * (first.point() - last.point());
    Real const size = length(along);
    Vec2 const normal = (1 / size) * left_of(along);
    measured = {dot(gap, normal) + 0.0, first.point()};  // adding 0 avoids -0
    gradient.add(first, section.sign * normal);
    gradient.add(last, -section.sign * normal);
    Vec2 const by_along = (1 / size) * (Vec2{gap.y, -gap.x} - (measured.value / size) * along);
    section.pull_chord({-1 * by_along, by_along}, gradient);
    return Status::ok;
}

Status measure_curvature(Section& section, QuantityKind kind, ControlGradient const& gradient,
                         Measured& measured, Fault& fault) noexcept {
    if (kind == QuantityKind::curvature_variation) {
        measured.at = section.first_end().point();
        return curvature_variation(section, measured.value, gradient, fault);
    }
    SmallestRadius bend;
    HARMORPH_TRY(smallest_radius(section, bend, gradient, fault));
    measured = {bend.radius, bend.place.point()};
    return Status::ok;
}

}  // namespace

Status measure(Section& section, Quantity const& quantity, ControlGradient const& gradient,
               Measured& measured, Fault& fault) noexcept {
    switch (quantity.kind) {
        case QuantityKind::area:
        case QuantityKind::centroid_x:
        case QuantityKind::centroid_y:
        case QuantityKind::moment_xx:
        case QuantityKind::moment_yy:
        case QuantityKind::moment_xy:
            return measure_area(section, quantity.kind, gradient, measured, fault);
        case QuantityKind::chord: return measure_chord(section, gradient, measured, fault);
        case QuantityKind::thickness:
        case QuantityKind::camber:
        case QuantityKind::max_thickness:
        case QuantityKind::max_camber:
            return measure_stations(section, quantity, gradient, measured, fault);
        case QuantityKind::leading_edge_radius:
            return measure_leading_edge(section, gradient, measured, fault);
        case QuantityKind::trailing_edge_angle:
            return measure_trailing_edge_angle(section, gradient, measured, fault);
        case QuantityKind::trailing_edge_gap:
            return measure_trailing_edge_gap(section, gradient, measured, fault);
        case QuantityKind::min_radius:
        case QuantityKind::curvature_variation:
            return measure_curvature(section, quantity.kind, gradient, measured, fault);
        case QuantityKind::twist: return measure_twist(section, gradient, measured, fault);
        case QuantityKind::min_thickness:
            return measure_min_thickness(section, quantity, gradient, measured, fault);
        case QuantityKind::distance:
            measure_distance(section, quantity, gradient, measured);
            return Status::ok;
        case QuantityKind::clearance: break;
    }
    bool const is_smooth = quantity.sharpness > 0;
    Clearance const found = is_smooth
                                ? smooth_clearance(section, quantity.polygon, quantity.n_polygon,
                                                   quantity.sharpness, gradient)
                                : measure_clearance(section, quantity.polygon, quantity.n_polygon);
    measured.value = found.value;
    measured.at = found.nearest.point();
    if (found.on_closing) {
        Vec2 const a = section.end_of(section.n_curves - 1, true).point(),
                   b = section.end_of(0, false).point();
        measured.at = a + found.along * (b - a);
    }
    if (!is_smooth) pull_clearance(section, found, gradient);
    return Status::ok;
}

}  // namespace harmorph
