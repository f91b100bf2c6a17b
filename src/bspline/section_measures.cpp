#include "bspline/section_measures.hpp"

#include "base/angle.hpp"
#include "bspline/section_clearance.hpp"
#include "bspline/section_curvature.hpp"
#include "bspline/section_distance.hpp"
#include "bspline/section_extremes.hpp"

namespace harmorph {
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
    Real const angle = sign * angle_of(turn_between(from, to));
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
