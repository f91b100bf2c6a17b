// The option of commands that draw: which part of the plane.
#pragma once

#include "arguments.hpp"
#include "geometry.hpp"

namespace cli {

extern const Option window_option;

bool has_window(const Arguments& arguments);
Box window_of(const Arguments& arguments);

} // namespace cli
