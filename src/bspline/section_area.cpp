#include "bspline/section_area.hpp"

#include "bspline/quadrature.hpp"

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

}  // namespace harmorph
