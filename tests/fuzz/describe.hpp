// A problem in words, for who looks into a case that failed.
#pragma once

#include "problem.hpp"

#include <string>

namespace fuzz {

std::string describe(Problem const& problem);

}  // namespace fuzz
