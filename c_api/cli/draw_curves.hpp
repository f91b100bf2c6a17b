// B-spline curves in pictures: their outline, control polygon and numbered control points.
#pragma once

#include "harmorph.h"
#include "plot.hpp"

namespace cli {

// The part of the plane that shows the curves (not all of their control points) and so many chords round them.
Box window_round(const std::vector<const hm_curves*>& curves, double chords);

void draw_outlines(Plot& plot, const hm_curves& curves, const std::string& attributes);
void draw_control_polygons(Plot& plot, const hm_curves& curves, const std::string& attributes);
void draw_control_points(Plot& plot, const hm_curves& curves, double radius, const std::string& attributes);

// The number (from 1) of a control point beside it: so many pixels outside the control polygon, or inside if negative.
void draw_number(Plot& plot, const hm_curves& curves, std::int32_t index, double distance,
                 const std::string& attributes);

Point control_point(const hm_curves& curves, std::int32_t index); // from 0

} // namespace cli
