// Repeat counts of Fortran's list-directed output, as 3*1.0 for 1.0 1.0 1.0.
#pragma once

#include <string>

namespace cli {

// False: the text has none. Otherwise `expanded` is the text with every number written out,
// in the line where it stands.
bool expand_repeats(const std::string& text, std::string& expanded);

}  // namespace cli
