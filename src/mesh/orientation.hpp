// Finds out which cells run clockwise. Two neighbours with the same orientation run along their
// common edge in opposite directions.
#pragma once

#include "base/arena.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

struct OrientationWork {
    Span<Index>
        parent;  // [n_cells] 2 * a cell whose orientation is known to be equal, + 1 if opposite
    Span<Real> balance;  // [n_cells] signed area of a connected component, at the root cell
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
};

// The orientation that all cells have in common, if no cell is inverted; mixed otherwise.
enum class Sense : std::int32_t { mixed, counter_clockwise, clockwise };
// Returns the common orientation of all cells. min_height becomes a lower bound of the heights of
// all corners, or 0 if the orientation is mixed.
Sense common_orientation(Mesh const& mesh, Real& min_height) noexcept;

// Sets topology.reversed; sense is the common orientation of the cells. In each connected
// component, the orientation with the larger total area is taken as counter-clockwise, so that a
// few inverted cells do not reverse the others. inverted becomes the first cell that then has a
// corner without positive area, or none.
Status orient(Topology& topology, Sense sense, OrientationWork const& work, Index& inverted,
              Fault& fault) noexcept;

}  // namespace harmorph
