// Options with places, which several commands have.
#pragma once

#include "basics/geometry.hpp"
#include "options/arguments.hpp"

#include <harmorph_design.h>

#include <optional>

namespace cli {

// The part of the plane that a picture shows; empty without --window.
std::optional<Box> window_of(const Arguments& arguments);

// The section in a curve file, with the chord of --chord.
hm_section section_of(const Arguments& arguments);

}  // namespace cli
