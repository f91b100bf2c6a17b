// Measures a section: computes one of the quantities below and its derivatives.
#pragma once

#include "bspline/section.hpp"

namespace harmorph {

// Computes area, centroid and second moments of a section by integrals along the outline (Green's
// theorem), and their derivatives.

// The second moments of the enclosed area are about the centroid; xx is the integral of (y -
// centroid.y)^2.
struct AreaMoments {
    Real area = 0, xx = 0, yy = 0, xy = 0;
    Vec2 centroid;
};

// The derivatives of a value by the moments.
using AreaDerivative = AreaMoments;

// Computes the moments and sets section.sign. Refuses outlines without area.
Status area_moments(Section& section, AreaMoments& moments, Fault& fault) noexcept;

void pull_area_moments(Section const& section, AreaMoments const& moments, AreaDerivative const& by,
                       ControlGradient const& gradient) noexcept;

// Computes measures of the curvature of a section and their derivatives: the radius at the leading
// edge, the smallest radius, and the variation.

// Computes the radius of curvature at the leading edge, which is positive if the outline is convex
// there. area_moments() and section.find_chord(true) must have been called.
Status radius_at_leading_edge(Section const& section, Real& radius, ControlGradient const& gradient,
                              Fault& fault) noexcept;

struct SmallestRadius {
    CurvePlace place;
    Real radius = 0;
};
// Computes the smallest radius of curvature of the curves, which is positive; corners do not count.
Status smallest_radius(Section const& section, SmallestRadius& bend,
                       ControlGradient const& gradient, Fault& fault) noexcept;

// Computes the integral of (d curvature / d arc length)^2 over the arc length: the minimum
// variation functional of H. Moreton and C. Sequin, Comput. Graph. 26 (1992) 167.
Status curvature_variation(Section const& section, Real& variation, ControlGradient const& gradient,
                           Fault& fault) noexcept;

// The C header has the same numbers, and explains the quantities.
enum class QuantityKind : std::int32_t {
    area = 0,
    centroid_x = 1,
    centroid_y = 2,
    moment_xx = 3,
    moment_yy = 4,
    moment_xy = 5,
    chord = 6,
    thickness = 7,
    camber = 8,
    max_thickness = 9,
    max_camber = 10,
    leading_edge_radius = 11,
    trailing_edge_angle = 12,
    trailing_edge_gap = 13,
    min_radius = 14,
    curvature_variation = 15,
    clearance = 16,
    twist = 17,
    min_thickness = 18,
    distance = 19
};

struct Quantity {
    QuantityKind kind = QuantityKind::area;
    Real station = 0;
    Points polygon;
    Index n_polygon = 0;
    Real last_station = 0;
    Real sharpness = 0;              // 1 / length; 0: no smooth bound
    const Section* other = nullptr;  // the other body of `distance`, connected
};

struct Measured {
    Real value = 0;
    Vec2 at;
};

// section.connect() must have been called.
Status measure(Section& section, Quantity const& quantity, ControlGradient const& gradient,
               Measured& measured, Fault& fault) noexcept;

}  // namespace harmorph
