// Counts of points, cells (and guards) and pairs of neighbours of a mesh: bounds for any part of
// the mesh.
#pragma once

#include "mesh/topology.hpp"

namespace harmorph {

struct RegionCounts {
    Index points = 0, cells = 0;
    Offset cell_corners = 0;  // of all cells
    Offset pairs = 0;         // of points that share a cell, each once

    static RegionCounts of(Topology const& topology) noexcept;
};

}  // namespace harmorph
