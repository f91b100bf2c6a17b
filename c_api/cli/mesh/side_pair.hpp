// Finds the translation or rotation that maps one side of a pair of --periodic onto the other.
#pragma once

#include "mesh/mesh_file.hpp"

#include <string>

namespace cli {

// A translation is tried first (HM_PERIODIC_PAIR), then a rotation about the origin, then a
// rotation about the centre that fits best (HM_ROTATION_PAIR). If no map fits, the condition is
// that of a translation, which the library refuses with the place of the misfit.
struct SidePair {
    hm_condition condition;
    std::string
        passage;  // "'left' to 'right' turned by 40 degrees about (0, 0)"; empty for translates
};
SidePair side_pair(const Mesh& mesh, std::int32_t marker, std::int32_t partner);

}  // namespace cli
