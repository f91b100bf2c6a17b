// The symbolic pass: which later unknowns each node of the assembly tree touches, and so the size
// of everything.
#pragma once

#include "dense/dense.hpp"
#include "ordering/subtree_ranges.hpp"

namespace harmorph {

// The front of a node is a dense symmetric matrix over the pivots and the border of the node. The
// border: positions of the later unknowns that the subtree is coupled to, increasing. That of node
// t is border[start[t]] .. border[start[t+1]-1].
struct FrontSizes {
    Offset border_entries = 0;  // of all fronts
    Offset factor_entries = 0;  // of all panels; a complex number is one entry
    Offset most_sums = 0;       // row sums of a front
};

struct BorderWork {
    // Entries for each position, on average: borders have of the order of n log n entries, and
    // reach 8 n on large meshes only.
    static constexpr Index remembered = 8;

    struct Step {
        Index parent;  // of the tree node
        Index seen;    // last position that passed the node
        Index filled;  // entries of the node's border so far
    };
    Span<Index> position;  // [n] of each unknown
    Span<Index> node;      // [n] tree node of each unknown
    Span<Step> step;       // [nodes]
    Span<Index>
        passed;  // [remembered * n] nodes that each position passed, and none; only while they fit
    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // Separate from lay_out(): this array may share memory with the working arrays of the
    // dissection.
    void lay_out_passed(Arena& arena, Index max_unknowns) noexcept;
};

// border_start [nodes + 1]: out, where the border of each node starts. Fills the working arrays
// that fill_borders() reads.
FrontSizes count_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
                         BorderWork const& work, Executor const& executor,
                         Span<Offset> border_start) noexcept;

// border [border_entries]. The executor must be that of count_borders(), as ranges depend on it;
// all is done by the calling thread.
void fill_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
                  BorderWork const& work, Executor const& executor, Span<const Offset> border_start,
                  Span<Index> border) noexcept;

}  // namespace harmorph
