// The control volumes of the unknowns: what local time steps and coarser levels need of the median
// dual's geometry.
#pragma once

#include "mesh/topology.hpp"

namespace harmorph {

struct ControlVolumes {
    Span<Real> area;           // [n]
    Span<Real> shortest_edge;  // [n] of the mesh edges at the point

    void lay_out(Arena& arena, Index n) noexcept;
    // unknown [n_points]: position of the unknown of each point, or below 0. The part of a cell
    // that belongs to a corner is bounded by the midpoints of the two edges there and the mean of
    // the cell's corners. All corners have positive areas.
    void measure(OrientedMesh const& cells, Points points, Span<const Index> unknown) noexcept;
};

}  // namespace harmorph
