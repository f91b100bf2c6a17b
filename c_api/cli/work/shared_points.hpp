// What the program says of points that belong to two moving conditions, see
// hm_basis_info.shared_point.
#pragma once

#include "mesh/mesh_file.hpp"

#include <harmorph.h>

#include <string>
#include <vector>

namespace cli {

void warn_of_shared_points(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                           const Mesh& mesh);
// Returns the reason for which a movement is refused that takes the two conditions of the point
// apart by a distance. `second` is the condition that does not move the point.
std::string why_torn(const hm_basis_info& info, const std::vector<hm_condition>& conditions,
                     const Mesh& mesh, std::int32_t point, std::int32_t second, double distance);

}  // namespace cli
