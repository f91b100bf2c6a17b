// Connected pieces of markers, and which of them belong to a body.
#pragma once

#include "basics/geometry.hpp"
#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <vector>

namespace cli {

struct BoundarySegment {
    std::int32_t marker = 0, loop = 0;  // the loop of the boundary, from 0, which has the piece
    std::int32_t faces = 0;
    std::int32_t point = 0;   // one of its points
    bool is_closed = true;    // two faces meet at each point
    bool is_of_body = false;  // the loop is not the one of the largest extent
    Box box;
};

// Returns the pieces marker by marker.
std::vector<BoundarySegment> marker_pieces(const Mesh& mesh);

}  // namespace cli
