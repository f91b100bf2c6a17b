// Markers by name: the library knows them by number only.
#pragma once

#include "mesh/mesh_file.hpp"

#include <string>
#include <vector>

namespace cli {

// Gives markers their numbers in the order of their names, so that those do not depend on the order
// in the file.
void number_by_name(Mesh& mesh);

// A sentence of the library with the names of markers for their numbers:
// "marker 4 slips" becomes "marker 'axis' slips".
std::string name_markers(const std::string& sentence, const std::vector<std::string>& names);

std::string listed(const std::vector<std::string>& names);  // "'a', 'b'", or "no markers"

}  // namespace cli
