// The option of drawing commands for the part of the plane that is shown.
#pragma once

#include "basics/geometry.hpp"
#include "options/arguments.hpp"

#include <optional>

namespace cli {

std::optional<Box> window_of(const Arguments& arguments);  // empty without --window

}  // namespace cli
