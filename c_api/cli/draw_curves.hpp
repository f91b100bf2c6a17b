// B-spline curves in pictures: their outline, control polygon and numbered control points.
#pragma once

#include "harmorph.h"
#include "plot.hpp"

namespace cli {

// What holds the curves (not all of their control points), and the mesh's points on rigid bodies.
Box box_of(const hm_curves& curves);
Box box_of_bodies(const hm_basis_info& info, const std::vector<double>& x, const std::vector<double>& y);
// The part of the plane that shows the boxes and so many chords round them.
Box window_round(const std::vector<Box>& boxes, double chords);

void draw_outlines(Plot& plot, const hm_curves& curves, const std::string& attributes);
void draw_control_polygons(Plot& plot, const hm_curves& curves, const std::string& attributes);
void draw_control_points(Plot& plot, const hm_curves& curves, double radius, const std::string& attributes);

// The number (from 1) of a control point beside it: so many pixels outside the control polygon, or inside if negative.
void draw_number(Plot& plot, const hm_curves& curves, std::int32_t index, double distance,
                 const std::string& attributes);

Point control_point(const hm_curves& curves, std::int32_t index); // from 0

} // namespace cli
