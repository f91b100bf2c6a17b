// Neutral map files (https://geolab.larc.nasa.gov/Volume/Doc/nmf.htm): which parts of a block's
// sides are what boundary.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct NmfPatch {
    std::string name;                       // the type of its boundary condition
    std::size_t block;                      // from 0
    int direction;                          // 0, 1, 2: a side i, j or k = constant
    bool at_end;                            // the last index and not the first
    std::array<std::int64_t, 3> low, high;  // points of the patch, from 0, both ends included
};

// Sides between blocks (ONE_TO_ONE) are not listed. Refuses, with the line, blocks of other sizes
// than these.
std::vector<NmfPatch> read_nmf(const std::string& path,
                               const std::vector<std::array<std::int64_t, 3>>& sizes);

}  // namespace cli
