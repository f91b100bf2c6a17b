// The advancing front: the unknowns in the order in which layers round the boundaries reach them.
#pragma once

#include "ordering/graph.hpp"

namespace harmorph {

struct LayerWork {
    Span<std::uint8_t> in_quad;  // [n] 1: a corner of a quad
    Span<std::uint8_t> reached;  // [n]

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
};

// order [n]: the unknowns by breadth-first search from those that share a cell with a point of
// known value or are on a free boundary. The front passes through regions of quads first, and only
// then through the triangles, so that the agglomeration merges boundary layers normal to the wall
// before it comes near other cells.
void order_by_layers(Topology const& topology, Span<const PointKind> kinds, Graph const& graph,
                     LayerWork const& work, Span<Index> order) noexcept;

}  // namespace harmorph
