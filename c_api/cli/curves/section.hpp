// The section of a body as points in order, and the two formats of airfoil files:
//
//     Selig     a line with the name, then lines x y from the trailing edge over the upper side
//               and back on the lower side
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

// Returns points on the first curve, ten for each span between knots. A straight base has none.
Section sampled(const Curves& curves);

// Writes the format of Selig, counter-clockwise from the beginning of the curve, or from the
// largest x of a periodic curve.
void write_selig(std::ostream& out, const Curves& curves);

}  // namespace cli
