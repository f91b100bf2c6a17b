// The subtrees of the assembly tree that are factored at the same time, and the memory that this
// takes.
#pragma once

#include "ordering/symbolic.hpp"

namespace harmorph {

// A subtree that one worker, a task with memory of its own, factors from the leaves to the root.
// The update matrix of the root is kept until the nodes above are factored. These nodes are
// factored one after the other, with all threads inside their large fronts.
struct Subtree {
    Index first = none, root = none;  // The nodes of the subtree are first .. root.
    // In entry k of the list of all subtrees: the number of the subtree with the k-th most work.
    Index by_work = none;
    Offset work = 0;       // The number of multiplications.
    Offset kept = 0;       // The update matrix of the root is kept here.
    Offset kept_rows = 0;  // The right-hand sides of the root's front are kept here.
};

struct Subtrees {
    // Each worker has several subtrees, so that unequal amounts of work balance.
    static constexpr Index per_worker = 2;

    Index workers = 1;
    Index count = 0;
    Span<Subtree> all;         // [count] Roots are increasing; one worker has no subtrees.
    Offset kept_entries = 0;   // The entries of all update matrices.
    Offset kept_rows = 0;      // The rows of the fronts of all roots.
    Offset stack_entries = 0;  // The update matrices along a path inside a subtree, below the root.
    // Those along a path above the subtrees; one worker has all here.
    Offset top_stack_entries = 0;
    Offset stack_rows = 0;  // The rows of the fronts along a path.
    // Returns the number of the subtree with this root, or none.
    Index find(Index node) const noexcept;

    static Index max_count(Index workers) noexcept {
        return workers > 1 ? per_worker * workers : 0;
    }
    void lay_out(Arena& arena, Index n_workers) noexcept;
    void choose(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;

private:
    void split(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;
    void sort_by_work() noexcept;
};

}  // namespace harmorph
