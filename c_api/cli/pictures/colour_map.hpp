// Colours for values of both signs. Colour-blind readers can distinguish them, and their order
// remains visible in grey print. The colour is nearly white at 0; positive values are green, blue
// and dark blue, negative values are orange and brown.
#pragma once

#include <string>

namespace cli {

std::string colour(double value);  // "#rrggbb"; values outside -1..1 have the colour of -1 or of 1

// Scales a value between -max and max to -1 .. 1, by the power 2/3, because harmonic functions have
// small values nearly everywhere.
double colour_place(double value, double max);

}  // namespace cli
