// Which parts of the assembly tree are worked on side by side, and what that costs in memory.
#pragma once

#include "harmorph/ordering/symbolic.hpp"

namespace harmorph {

// A subtree that one lane (one thread's sequence of work) does from its leaves to its root. What it leaves for the nodes
// above is kept until they are done, by the calling thread with all threads inside their large fronts.
struct Subtree {
    Index first = none, root = none;  // its nodes are numbered first .. root
    Index lane = 0;
    Offset work = 0;   // multiplications
    Offset kept = 0;   // where its update matrix is kept
    Offset kept_rows = 0;  // where its root's right-hand sides are kept
    bool adds_nothing = false;  // those at hand are 0, and nothing is kept
};

struct Subtrees {
    static constexpr Index per_lane = 4;  // so that unequal ones can be shared out evenly

    Index lanes = 1;
    Index count = 0;
    Span<Subtree> all;            // [count] by increasing root; none with one lane
    Offset kept_entries = 0;      // of all update matrices
    Offset kept_rows = 0;         // of all roots' fronts
    Offset stack_entries = 0;     // update matrices of a path inside a subtree, below its root
    Offset top_stack_entries = 0; // of a path above the subtrees; everything with one lane
    Offset stack_rows = 0;        // fronts of a path
    Index find(Index node) const noexcept;  // number of the subtree that has its root there, or none

    static Index most(Index lanes) noexcept { return lanes > 1 ? per_lane * lanes : 0; }
    void lay_out(Arena& arena, Index n_lanes) noexcept;
    void choose(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;

private:
    void split(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;
    void share_out() noexcept;
};

}  // namespace harmorph
