// An example of a curve file; `#` starts a comment, and control points are numbered from 1:
//
//     degree 3
//     closed tied       # open; tied: the first point is the last one, too; periodic: the first
//                       # 3 points (the degree) stand again at the end
//     points 20         # 20 lines x y
//     knots 25          # as many values as control points with repeats, and degree + 1 more
//     indices 21        # if the points are not used in order: the numbers of the points
//     weights 20        # if the curve is rational
//     curve             # another curve over the same points: degree, closed, indices, knots
#pragma once

#include "curves/curves.hpp"
#include "basics/output_file.hpp"

#include <iosfwd>
#include <string>

namespace cli {

Curves read_curves(const std::string& path);
Curves read_curves(const std::string& path, std::string text);  // reads `text` instead of the file
void write_curves(std::ostream& out, const Curves& curves);

// Text for the help of commands: the ending of the path selects the format.
#define CURVE_FORMATS                                                                             \
    "the name's end chooses: .igs, .iges IGES (entity 126); .stp, .step STEP; .nml Fortran "      \
    "namelists;\n"                                                                                \
    ".dat points on the curve as Selig's files have them; else the text file that solve --curve " \
    "reads"
bool ends_with(const std::string& path, const std::string& ending);  // in capital or small letters
void write_curve_file(OutputFiles& files, const std::string& path, const Curves& curves);

}  // namespace cli
