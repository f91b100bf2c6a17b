// The section of a body as points in order, and the files that airfoils are published in:
//
//     Selig      a line with the name, then lines x y from the trailing edge over the upper side
//     and back below Lednicer   a line with the name, a line with the numbers of points above and
//     below, then the upper side from the
//                leading edge on, a blank line, and the lower side from the leading edge on
#pragma once

#include "curves/curves.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Section {
    std::vector<double> x, y;  // of a loop, the first point is not repeated
    bool is_loop = true;
};

Section read_section(
    const std::string& path);  // either format; what is wrong is told with its line

// Points on the first curve, ten for each span between knots; without the straight base, which they
// leave open.
Section sampled(const Curves& curves);

// In Selig's format: counter-clockwise from the curve's beginning, of a smooth one from its largest
// x.
void write_selig(std::ostream& out, const Curves& curves);

}  // namespace cli
