// The control volumes of the unknowns: what local time steps and coarser levels need of the median dual's geometry.
#pragma once

#include "harmorph/mesh/topology.hpp"

namespace harmorph {

struct ControlVolumes {
    Span<Real> area;           // [n]
    Span<Real> shortest_edge;  // [n] of the mesh edges at the point

    void lay_out(Arena& arena, Index n) noexcept;
    // place [n_points]: position of each point's unknown, or below 0. A cell's part of a corner is bounded by the midpoints of
    // the edges there and the barycentre of the cell's corners. All corners have positive areas.
    void measure(OrientedMesh const& cells, Points points, Span<const Index> place) noexcept;
};

}  // namespace harmorph
