// Colours for values of both signs, which people who see no red, or no green, tell apart and which
// stay in order when printed in grey: nearly white at 0, over green and blue to dark blue upwards,
// over orange to brown downwards.
#pragma once

#include <string>

namespace cli {

std::string colour(
    double value);  // "#rrggbb"; from -1 to 1, values outside are taken for the nearest inside

// Where between -1 and 1 a value stands whose largest size is `most`: by the power 2/3, as harmonic
// functions have small values nearly everywhere.
double colour_place(double value, double most);

}  // namespace cli
