// The section of a body as points in order, and the two formats of airfoil files:
//
//     Selig     a line with the name, then lines x y from the trailing edge along the upper side
//               to the leading edge, and back along the lower side
//     Lednicer  a line with the name, a line with the numbers of points of both sides, then the
//               upper side from the leading edge, a blank line, and the lower side from the
//               leading edge
#pragma once

#include "curves/curves.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Section {
    std::vector<double> x, y;  // the first point of a loop is not repeated
    bool is_loop = true;
};

Section read_section(const std::string& path);  // reads both formats; errors name the line

// Returns points on the first curve, ten for each span between knots. Other curves, such as a
// straight base, are not sampled.
Section sampled(const Curves& curves);

// Writes the format of Selig: the points of the first curve, counter-clockwise from an end of the
// curve, or from the largest x of a periodic curve.
void write_selig(std::ostream& out, const Curves& curves);

}  // namespace cli
