// Draws contour lines, with values written on some of them.
#pragma once

#include "pictures/contour_lines.hpp"
#include "pictures/plot.hpp"

namespace cli {

// taken: places where no value may be written [pixels].
void draw_contours(Plot& plot, const std::vector<ContourLine>& lines, double step,
                   const std::vector<Point>& taken);

}  // namespace cli
