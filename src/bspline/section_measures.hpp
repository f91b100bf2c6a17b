// Measures a section: computes one of the quantities below and its derivatives.
#pragma once

#include "bspline/section_area.hpp"

namespace harmorph {

// The numbers are those of the C header, which explains them.
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
