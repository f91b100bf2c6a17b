// Colours for values between 0 and 1: dark blue, green, yellow, evenly brighter on the way.
#pragma once

#include <string>

namespace cli {

std::string colour(double value);  // "#rrggbb"; values outside are taken for the nearest inside
std::string colour_gradient_stops(); // the same as stops of an SVG gradient

} // namespace cli
