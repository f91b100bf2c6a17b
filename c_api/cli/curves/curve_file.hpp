// Files of B-spline curves.
#pragma once

#include "curves/curves.hpp"
#include "files/output_file.hpp"
#include "files/text_file.hpp"

#include <iosfwd>
#include <string>

namespace cli {

// An example of a curve file; `#` starts a comment, and control points are numbered from 1:
//
//     degree 3
//     closed tied       # open; tied: the first point is also the last one; periodic: the first 3
//                       # points (as many as the degree) are repeated at the end; they may also be
//                       # written again there, and then count as points
//     points 20         # 20 lines x y
//     knots 25          # as many values as control points with repeats, and degree + 1 more
//     indices 21        # if the points are not used in order: the numbers of the points
//     weights 20        # if the curve is rational
//     curve             # another curve over the same points: degree, closed, indices, knots

Curves read_curves(const std::string& path);
bool is_curve_file(const TextFile& file);                       // by the first word of the content
Curves read_curves(const std::string& path, std::string text);  // reads `text` instead of the file
void write_curves(std::ostream& out, const Curves& curves);

// The extension of the path selects the format.
void write_curve_file(OutputFiles& files, const std::string& path, const Curves& curves);

}  // namespace cli
