// The symbolic pass: which later unknowns each node of the assembly tree touches. The sizes of all
// arrays follow from that.
#pragma once

#include "dense/dense.hpp"
#include "ordering/subtree_ranges.hpp"

namespace harmorph {

// The front of a node is a dense symmetric matrix over the pivots and the border of the node. The
// border contains the positions of the later unknowns to which the subtree is coupled, in
// increasing order. The border of node t is border[start[t]] .. border[start[t+1]-1].
struct FrontSizes {
    Offset border_entries = 0;  // The entries of the borders of all fronts.
    Offset factor_entries = 0;  // The entries of all panels; a complex number is one entry.
    Offset max_sums = 0;        // The largest number of row sums of a front.
};

struct BorderWork {
    // The number of entries for each position, on average. Borders have of the order of n log n
    // entries, and exceed 8 n on large meshes only.
    static constexpr Index passed_per_position = 8;

    struct Step {
        Index parent;  // The parent of the tree node.
        Index seen;    // The last position that passed the node.
        Index filled;  // The number of entries of the node's border so far.
    };
    Span<Index> position;  // [n] The position of each unknown.
    Span<Index> node;      // [n] The tree node of each unknown.
    Span<Step> step;       // [nodes]
    // [passed_per_position * n] The nodes that each position passed, then none; only as long as
    // they fit.
    Span<Index> passed;
    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // Laid out apart from lay_out(), as it may share memory with the working arrays
    // of the dissection.
    void lay_out_passed(Arena& arena, Index max_unknowns) noexcept;
};

// Fills border_start [nodes + 1] with the start of the border of each node, and the working arrays
// that fill_borders() reads.
FrontSizes count_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
                         BorderWork const& work, Executor const& executor,
                         Span<Offset> border_start) noexcept;

// Fills border [border_entries]. The executor must be that of count_borders(), as ranges depend on
// it; the calling thread does all the work.
void fill_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
                  BorderWork const& work, Executor const& executor, Span<const Offset> border_start,
                  Span<Index> border) noexcept;

}  // namespace harmorph
