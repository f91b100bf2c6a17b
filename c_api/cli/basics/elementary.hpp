// Functions whose results are written into files. Those of the C library differ in the last digit
// from one system to another; these consist of operations that are rounded alike everywhere, so
// that files have the same bytes in node and on all processors.
#pragma once

#include "basics/sine_cosine.hpp"

namespace cli {

// Returns the angle [radians, -pi .. pi] from the x axis to (x, y), within 3 units in the last
// place; 0 for (0, 0).
double angle_of(double x, double y);

// Returns the square root of x^2 + y^2, within one unit in the last place.
double length_of(double x, double y);

// Returns the exponent of a number other than 0 in decimal notation, d.ddd 10^exponent with d from
// 1 to 9.
int decimal_exponent(double value);

}  // namespace cli
