// Finds how one side of a pair of --periodic is mapped onto the other.
#pragma once

#include "mesh/mesh_file.hpp"

#include <string>

namespace cli {

// The sides are translates of each other (HM_PERIODIC_PAIR), or, if a translation does not fit, one
// is the other one turned (HM_ROTATION_PAIR) about the origin, or else about the centre that fits
// best. Sides that are neither count as translates, which the library refuses with the place.
struct SidePair {
    hm_condition condition;
    std::string
        passage;  // "'left' to 'right' turned by 40 degrees about (0, 0)"; empty for translates
};
SidePair side_pair(const Mesh& mesh, std::int32_t marker, std::int32_t partner);

}  // namespace cli
