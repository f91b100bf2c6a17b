// Finds edges that are connected by their ends. Edges of a closed boundary form loops; edges of a
// part of a boundary may form open chains. Both are called loops here.
#pragma once

#include <cstdint>
#include <vector>

namespace cli {

struct BoundaryLoops {
    std::int32_t count = 0;
    // The loop of each edge, from 0. Loops are in the order of their smallest points.
    std::vector<std::int32_t> of_edge;

    // ends: two points of each edge, between 0 and n_points - 1.
    BoundaryLoops(const std::vector<std::int32_t>& ends, std::int32_t n_points);
};

}  // namespace cli
