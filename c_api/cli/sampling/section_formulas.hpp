// Sections of chord 1 by formulas, as points in order: counter-clockwise from the upper end of the
// trailing edge.
#pragma once

#include "curves/section.hpp"

#include <vector>

namespace cli {

// NACA four-digit section with a sharp trailing edge, in chords. The camber may be negative.
Section naca_section(double camber, double camber_at, double thickness);

// Class-shape transformation with a round leading edge (B. Kulfan, J. Aircraft 45 (2008) 142):
// sqrt(x) (1 - x) times Bernstein polynomials with these weights, and half of `base` times x.
Section cst_section(const std::vector<double>& upper, const std::vector<double>& lower,
                    double base);

}  // namespace cli
