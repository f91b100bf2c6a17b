// Computes the areas and shortest edges of the unknowns' control volumes in the median dual, which
// local time steps and coarser levels need.
#pragma once

#include "mesh/topology.hpp"

namespace harmorph {

struct ControlVolumes {
    Span<Real> area;           // [n]
    Span<Real> shortest_edge;  // [n] the length of the shortest mesh edge at the point

    void lay_out(Arena& arena, Index n) noexcept;
    // unknown [n_points] is the position of the unknown of each point, or negative. A corner's
    // share of a cell is the quadrilateral of the corner, the midpoints of the two edges there, and
    // the mean of the cell's corners. All corners must have positive areas.
    void measure(OrientedMesh const& cells, Points points, Span<const Index> unknown) noexcept;
};

}  // namespace harmorph
