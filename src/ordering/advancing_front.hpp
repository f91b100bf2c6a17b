// The advancing front: the order of the unknowns in which layers round the boundaries reach them.
#pragma once

#include "ordering/graph.hpp"

namespace harmorph {

struct LayerWork {
    Span<std::uint8_t> in_quad;  // [n] The value is 1 if the unknown belongs to a corner of a quad.
    Span<std::uint8_t> reached;  // [n] The value is 1 if the front has reached the unknown.

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
};

// Fills order [n] with the unknowns, by breadth-first search from those that share a cell with a
// point of known value or are on a free boundary. The front passes through regions of quads first,
// and only then through the triangles, so that the agglomeration merges boundary layers normal to
// the wall before it merges other cells.
void order_by_layers(Topology const& topology, Span<const PointKind> kinds, Graph const& graph,
                     LayerWork const& work, Span<Index> order) noexcept;

}  // namespace harmorph
