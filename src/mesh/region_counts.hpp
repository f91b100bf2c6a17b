// Counts points, cells with guards, and pairs of neighbours in a mesh. The counts bound those of
// any region of the mesh. tests/safe/test_region.cpp covers this file.
#pragma once

#include "mesh/topology.hpp"

namespace harmorph {

struct RegionCounts {
    Index points = 0, cells = 0;
    Offset cell_corners = 0;  // the number of corners of all cells
    Offset pairs = 0;         // the number of pairs of points that have a cell in common

    static RegionCounts of(Topology const& topology) noexcept;
};

}  // namespace harmorph
