// The symbolic pass: which later unknowns each node of the assembly tree touches, and so the size of everything.
#pragma once

#include "harmorph/dense/dense.hpp"
#include "harmorph/ordering/nested_dissection.hpp"

namespace harmorph {

// The front of a node is a dense symmetric matrix over its pivots and its border: the positions of later unknowns that
// its subtree is coupled to, increasing. Node t's border is border[start[t]] .. border[start[t+1]-1].
struct FrontSizes {
    Offset border_entries = 0;  // of all fronts
    Offset factor_entries = 0;  // of all panels; a complex number is one entry
    Offset most_sums = 0;       // row sums of a front
    Index largest_border = 0;
};

struct BorderWork {
    static constexpr Index remembered = 8;  // entries for each position, on average; fill n log n takes long to get there

    struct Step {
        Index parent;  // of the tree node
        Index seen;    // last position that passed it
        Index filled;  // entries of its border so far
    };
    Span<Index> position;  // [n] of each unknown
    Span<Index> node;      // [n] tree node of each unknown
    Span<Step> step;       // [nodes]
    Span<Index> passed;    // [remembered * n] nodes that each position passed, and none; only while they fit
    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // Apart, because the dissection's room serves.
    void lay_out_passed(Arena& arena, Index max_unknowns) noexcept;
};

// border_start [nodes + 1]: counts, then starts. Fills what fill_borders goes by.
FrontSizes count_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                         Executor const& executor, Span<Offset> border_start) noexcept;

// border [border_entries]. The executor is count_borders's, but the calling thread does it all.
void fill_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                  Executor const& executor, Span<const Offset> border_start, Span<Index> border) noexcept;

}  // namespace harmorph
