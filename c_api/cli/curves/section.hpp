// Sections that are sampled from curves, and written as airfoil files.
#pragma once

#include "curves/curves.hpp"
#include "curves/section_read.hpp"

#include <iosfwd>

namespace cli {

// Returns points on the first curve, ten for each span between knots. Other curves, such as a
// straight base, are not sampled.
Section sampled(const Curves& curves);

// Writes the format of Selig: the points of the first curve, counter-clockwise from an end of the
// curve, or from the largest x of a periodic curve.
void write_selig(std::ostream& out, const Curves& curves);

}  // namespace cli
