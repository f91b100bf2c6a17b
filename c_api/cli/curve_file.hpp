// Curve files, by example (`#` starts a comment; control points are numbered from 1):
//
//     degree 3
//     closed tied            # open; tied: both ends are the first point; periodic: the first 3 points again at the end
//     points 20              # 20 lines x y
//     knots 25               # as many values as control points with their repeats, degree and 1 together
//     indices 21             # if the points are not used in order: which are
//     weights 20             # if the curve is rational
//     curve                  # another curve over the same points: degree, closed, indices, knots
#pragma once

#include "curves.hpp"

#include <iosfwd>
#include <string>

namespace cli {

Curves read_curves(const std::string& path);
void write_curves(std::ostream& out, const Curves& curves);

} // namespace cli
