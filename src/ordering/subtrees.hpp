// Which parts of the assembly tree are factored at the same time, and the memory that this takes.
#pragma once

#include "ordering/symbolic.hpp"

namespace harmorph {

// A subtree that one worker, a task with memory of its own, factors from the leaves to the root.
// The update matrix of the root is kept until the nodes above are factored: these are done one by
// one, with all threads inside their large fronts.
struct Subtree {
    Index first = none, root = none;  // the nodes of the subtree are first .. root
    Index by_work =
        none;         // in the list of all: the number of the subtree that has the k-th most work
    Offset work = 0;  // multiplications
    Offset kept = 0;  // where the update matrix of the root is kept
    Offset kept_rows = 0;  // where the right-hand sides of the root's front are kept
};

struct Subtrees {
    static constexpr Index per_worker =
        2;  // several for each worker, so that subtrees of unequal work balance

    Index workers = 1;
    Index count = 0;
    Span<Subtree> all;             // [count] by increasing root; none with one worker
    Offset kept_entries = 0;       // of all update matrices
    Offset kept_rows = 0;          // of all roots' fronts
    Offset stack_entries = 0;      // update matrices of a path inside a subtree, below the root
    Offset top_stack_entries = 0;  // of a path above the subtrees; everything with one worker
    Offset stack_rows = 0;         // fronts of a path
    Index find(
        Index node) const noexcept;  // number of the subtree that has its root there, or none

    static Index most(Index workers) noexcept { return workers > 1 ? per_worker * workers : 0; }
    void lay_out(Arena& arena, Index n_workers) noexcept;
    void choose(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;

private:
    void split(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;
    void sort_by_work() noexcept;
};

}  // namespace harmorph
