// Markers have names in files, and numbers in the library.
#pragma once

#include "mesh/mesh_file.hpp"

#include <string>
#include <vector>

namespace cli {

// Gives markers their numbers in the order of their names, so that the numbers do not depend on
// the order in the file.
void number_by_name(Mesh& mesh);

std::string listed(const std::vector<std::string>& names);  // "'a', 'b'", or "no markers"

}  // namespace cli
