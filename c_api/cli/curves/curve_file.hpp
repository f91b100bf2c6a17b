// Curve files, by example (`#` starts a comment; control points are numbered from 1):
//
//     degree 3
//     closed tied            # open; tied: both ends are the first point; periodic: the first 3
//     points again at the end points 20              # 20 lines x y knots 25               # as
//     many values as control points with their repeats, degree and 1 together indices 21 # if the
//     points are not used in order: which are weights 20             # if the curve is rational
//     curve                  # another curve over the same points: degree, closed, indices, knots
#pragma once

#include "curves/curves.hpp"
#include "basics/output_file.hpp"

#include <iosfwd>
#include <string>

namespace cli {

Curves read_curves(const std::string& path);
Curves read_curves(const std::string& path, std::string text);  // text: instead of what is there
void write_curves(std::ostream& out, const Curves& curves);

// In the format that the path ends with; for the help of commands.
#define CURVE_FORMATS                                                                             \
    "the name's end chooses: .igs, .iges IGES (entity 126); .stp, .step STEP; .nml Fortran "      \
    "namelists;\n"                                                                                \
    ".dat points on the curve as Selig's files have them; else the text file that solve --curve " \
    "reads"
bool ends_with(const std::string& path, const std::string& ending);  // in either case of letters
void write_curve_file(OutputFiles& files, const std::string& path, const Curves& curves);

}  // namespace cli
