// The symbolic pass: which later unknowns each node of the assembly tree touches, and so the size of everything.
#pragma once

#include "harmorph/dense.hpp"
#include "harmorph/dissection.hpp"

namespace harmorph {

// The front of a node is a dense symmetric matrix over its pivots and its border: the positions of later unknowns that
// its subtree is coupled to, increasing. Node t's border is border[start[t]] .. border[start[t+1]-1].
struct FrontSizes {
    Offset border_entries = 0;  // of all fronts
    Offset factor_entries = 0;  // of all panels; a complex number is one entry
    Index largest_front = 0;    // pivots + border
    Index largest_border = 0;
};

struct BorderWork {
    Span<Index> node;       // [n] tree node of each position
    Span<Index> position;   // [n] of each unknown
    Span<Index> seen;       // [nodes] last position that passed the node
    Span<Index> filled;     // [nodes] entries of each border so far
    void lay_out(Arena& arena, Index max_unknowns) noexcept;
};

// border_start [nodes + 1]: counts, then starts. Fills work.node and work.position for fill_borders.
FrontSizes count_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                         Executor const& executor, Span<Offset> border_start) noexcept;

// border [border_entries].
void fill_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                  Span<const Offset> border_start, Span<Index> border) noexcept;

}  // namespace harmorph
