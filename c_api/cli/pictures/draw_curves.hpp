// Draws B-spline curves: outline, control polygon, and numbered control points.
#pragma once

#include "pictures/plot.hpp"

#include <harmorph.h>

namespace cli {

// Returns the parameters at which a picture samples a curve, 24 between two knots.
std::vector<double> sample_parameters(const hm_curve& curve);

// Return the boxes that contain the curves (not all control points), and the mesh points on rigid
// bodies.
Box box_of(const hm_curves& curves);
Box box_of_bodies(const hm_basis_info& info, const std::vector<double>& x,
                  const std::vector<double>& y);
// Returns a window with the boxes and a margin of so many times the larger side of all boxes.
Box window_round(const std::vector<Box>& boxes, double chords);

void draw_outlines(Plot& plot, const hm_curves& curves, const std::string& attributes);
void draw_control_polygons(Plot& plot, const hm_curves& curves, const std::string& attributes);
void draw_control_points(Plot& plot, const hm_curves& curves, double radius,
                         const std::string& attributes);

// Writes the numbers (from 1) of control points, style.distance pixels outside the control polygon.
// Numbers that would overlap others are not written. The number of `chosen` (-1: none) has its own
// style and is written first.
struct LabelStyle {
    double distance, font_size;
    const char* attributes;
};
void draw_numbers(Plot& plot, const hm_curves& curves, const LabelStyle& style,
                  std::int32_t chosen = -1, const LabelStyle& chosen_style = {0, 0, ""});

// Returns the place of a control point in the polygon of a curve, from 0, or -1.
std::int32_t place_on_curve(const hm_curves& curves, std::int32_t curve, std::int32_t index);
Point control_point(const hm_curves& curves, std::int32_t index);  // the index begins at 0

}  // namespace cli
