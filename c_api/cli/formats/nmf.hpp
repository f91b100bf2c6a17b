// Neutral map files (https://geolab.larc.nasa.gov/Volume/Doc/nmf.htm): the boundary
// conditions of parts of the sides of blocks.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct NmfPatch {
    std::string name;                       // the type of the boundary condition
    std::size_t block;                      // from 0
    int direction;                          // 0, 1, 2: a side i, j or k = constant
    bool at_end;                            // at the last index, and not at the first
    std::array<std::int64_t, 3> low, high;  // points of the patch, from 0, both ends included
};

// Reads the patches, except for sides between blocks (ONE_TO_ONE). Refuses, with the line, blocks
// of other sizes.
std::vector<NmfPatch> read_nmf(const std::string& path,
                               const std::vector<std::array<std::int64_t, 3>>& sizes);

}  // namespace cli
