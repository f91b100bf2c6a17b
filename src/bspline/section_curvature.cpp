#include "harmorph/bspline/section_curvature.hpp"

#include "harmorph/base/angle.hpp"
#include "harmorph/bspline/quadrature.hpp"

namespace harmorph {
namespace {

constexpr Vec2 right_of(Vec2 v) noexcept { return {v.y, -v.x}; }

// Curvature k = C' x C'' / |C'|^3 and its derivative by the parameter, of derivatives c[1..3] of a curve; and the
// derivatives of both by C', C'' and C'''.
struct Curvature {
    Real value = 0, slope = 0, speed = 0;
    Vec2 value_by[3], slope_by[4];

    explicit Curvature(const Vec2* c) noexcept {
        Real const q = square(c[1]), d = dot(c[1], c[2]), x = cross(c[1], c[2]), y = cross(c[1], c[3]);
        speed = square_root(q);
        Real const q3 = 1 / (q * speed), q5 = q3 / q, q7 = q5 / q;
        value = x * q3;
        slope = y * q3 - 3 * x * d * q5;
        // Of the cross products by their factors: of C' x C'' by C' it is C'' turned right, by C'' it is C' turned
        // left.
        Vec2 const x1 = right_of(c[2]), x2 = left_of(c[1]), y1 = right_of(c[3]);
        value_by[1] = q3 * x1 - 3 * x * q5 * c[1];
        value_by[2] = q3 * x2;
        slope_by[1] = q3 * y1 - 3 * y * q5 * c[1] - 3 * q5 * (d * x1 + x * c[2]) + 15 * x * d * q7 * c[1];
        slope_by[2] = -3 * q5 * (d * x2 + x * c[1]);
        slope_by[3] = q3 * x2;
    }
};

Curvature curvature_at(CurvePlace const& place) noexcept {
    Vec2 c[4];
    place.derivatives(3, c);
    return Curvature(c);
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
            status = fault.refuse(Status::bad_curve,
                                  "curve @ (from 0) stands still at parameter ~: it has no curvature there",
                                  Counts::from_zero, none, c, low + (high - low) * j / n);
        }
    });
    return status;
}

}  // namespace

Status nose_radius(Section const& section, Real& radius, ControlGradient const& gradient, Fault& fault) noexcept {
    Curvature const at = curvature_at(section.nose_place);
    Real const bend = section.sign * (section.backwards[section.nose_place.curve - section.curve] ? -1 : 1) * at.value;
    if (!section.nose_is_smooth || !is_finite(bend) || !(absolute(bend) * section.extent() > 1e-12)) {
        return fault.refuse(Status::bad_curve,
                            "the leading edge is a corner or straight: it has no radius of curvature");
    }
    radius = 1 / bend;
    Real const by_value = -radius * radius * bend / at.value;  // bend / value: the sign
    Vec2 const by[3] = {{}, by_value * at.value_by[1], by_value * at.value_by[2]};
    gradient.add(section.nose_place, 2, by);
    section.pull_nose({}, by_value * at.slope, gradient);
    return Status::ok;
}

Status smallest_radius(Section const& section, Bend& bend, ControlGradient const& gradient, Fault& fault) noexcept {
    HARMORPH_TRY(check_speed(section, fault));
    Real largest = 0;
    section.for_each_span(0, section.n_curves, [&](Index c, Index span, Real low, Real high) {
        Curve const& curve = section.curve[c];
        auto const include = [&](Real u) {
            CurvePlace const place{&curve, span, u};
            Real const found = absolute(curvature_at(place).value);
            if (!(found > largest)) return;
            largest = found;
            bend.place = place;
        };
        Index const n = 8 * curve.degree;
        auto const slope = [&](Real u) {  // of k^2 / 2
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
    if (!(largest * section.extent() > 1e-12)) {
        return fault.refuse(Status::bad_curve, "the outline is straight: it has no radius of curvature");
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
        return fault.refuse(Status::bad_curve, "curve @ (from 0) of the section has degree 1 and no curvature",
                            Counts::from_zero, none, c);
    }
    HARMORPH_TRY(check_speed(section, fault));
    variation = 0;
    section.for_each_span(0, section.n_sides, [&](Index c, Index span, Real low, Real high) {
        auto const integrand = [&](Real u) {
            Curvature const at = curvature_at({&section.curve[c], span, u});
            Real const square_value = at.value * at.value;
            return Sums<2>{{at.slope * at.slope / at.speed, square_value * square_value * at.speed}};
        };
        for_converged<2>(low, high, integrand, [&](Real a, Real b) {
            Gauss10::for_each(a, b, [&](Real u, Real weight) {
                CurvePlace const place{&section.curve[c], span, u};
                Vec2 point[4];
                place.derivatives(3, point);
                Curvature const at(point);
                variation += weight * at.slope * at.slope / at.speed;
                Real const by_slope = 2 * weight * at.slope / at.speed;
                Real const by_square_speed = -0.5 * weight * at.slope * at.slope / (at.speed * at.speed * at.speed);
                Vec2 const by[4] = {{}, by_slope * at.slope_by[1] + 2 * by_square_speed * point[1],
                                    by_slope * at.slope_by[2], by_slope * at.slope_by[3]};
                gradient.add(place, 3, by);
            });
        });
    });
    return Status::ok;
}

}  // namespace harmorph
