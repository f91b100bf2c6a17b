// Which cells run clockwise: neighbours with the same orientation traverse their common edge in
// opposite directions.
#pragma once

#include "base/arena.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

struct OrientationWork {
    Span<Index> parent;  // [n_cells] 2 * cell it agrees with, + 1 if in the opposite sense
    Span<Real> balance;  // [n_cells] area of a connected part, signed by agreement with the root
    void lay_out(Arena& arena, Mesh const& mesh) noexcept;
};

// Of all cells, none of them inverted, or mixed.
enum class Sense : std::int32_t { mixed, counter_clockwise, clockwise };
// least_height: out, no corner of any cell is lower; 0 where the sense is mixed.
Sense common_sense(Mesh const& mesh, Real& least_height) noexcept;

// Sets topology.reversed. sense: the cells' common one. In each connected part the sense with the
// larger total area is the right one, so that few inverted cells do not turn the others. inverted:
// the first cell that has a corner of no positive area then, or none.
Status orient(Topology& topology, Sense sense, OrientationWork const& work, Index& inverted,
              Fault& fault) noexcept;

}  // namespace harmorph
