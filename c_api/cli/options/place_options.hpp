// Options with places, which several commands have.
#pragma once

#include "basics/geometry.hpp"
#include "options/arguments.hpp"

#include <harmorph_design.h>

#include <optional>
#include <vector>

namespace cli {

// The part of the plane that a picture shows; empty without --window.
std::optional<Box> window_of(const Arguments& arguments);

// The section in a curve file, with the chord of --chord.
hm_section section_of(const Arguments& arguments);

// The stations of --stations, from 0 at the leading edge to 1 at the trailing edge, both excluded.
// Refuses two stations that have the same name, which has four digits.
std::vector<double> stations_of(const Arguments& arguments);

}  // namespace cli
