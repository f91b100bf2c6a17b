// The option of commands that draw: which part of the plane.
#pragma once

#include "basics/arguments.hpp"
#include "basics/geometry.hpp"

#include <optional>

namespace cli {

extern const Option window_option;

std::optional<Box> window_of(const Arguments& arguments);  // nothing: not given

}  // namespace cli
