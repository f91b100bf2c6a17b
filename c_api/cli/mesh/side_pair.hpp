// What --periodic finds out: how one side of a pair is mapped onto the other.
#pragma once

#include "mesh/mesh_file.hpp"

#include <string>

namespace cli {

// Translates of each other (HM_PERIODIC_PAIR), or, where a translation does not fit, turned
// (HM_ROTATION_PAIR): about the origin if that fits, otherwise about the centre that fits best.
// Sides that are neither count as translates, which the library refuses with the place.
struct SidePair {
    hm_condition condition;
    std::string
        passage;  // "'left' to 'right' turned by 40 degrees about (0, 0)"; empty of translates
};
SidePair side_pair(const Mesh& mesh, std::int32_t marker, std::int32_t partner);

}  // namespace cli
