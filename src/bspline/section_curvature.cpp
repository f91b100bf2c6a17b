#include "bspline/section_curvature.hpp"

#include "base/angle.hpp"
#include "bspline/quadrature.hpp"

namespace harmorph {
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
        // The derivative of C' x C'' by C' is C'' turned right, and by C'' it is C' turned left.
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

}  // namespace harmorph
