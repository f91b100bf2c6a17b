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
    // The update matrices along a path above the subtrees; one worker has all of them here.
    Offset top_stack_entries = 0;
    Offset stack_rows = 0;  // The rows of the fronts along a path.
    // Returns the number of the subtree with this root, or none.
    Index find(Index node) const noexcept;

    static Index max_count(Index workers) noexcept {
        return workers > 1 ? per_worker * workers : 0;
    }
    void lay_out(Arena& arena, Index n_workers) noexcept;
    void choose(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;
    // Computes the sizes for subtrees that have been chosen: `chosen` are their roots. `all` gets
    // the places of what is kept, unless it is empty. The functions return the size of the border
    // and of the front of a node.
    template <class Border, class Front>
    void measure(AssemblyTree const& tree, Span<const Subtree> chosen, Border const& border,
                 Front const& front) noexcept;

private:
    void split(AssemblyTree const& tree, Span<const Offset> border_start) noexcept;
    void sort_by_work() noexcept;
};

template <class Border, class Front>
void Subtrees::measure(AssemblyTree const& tree, Span<const Subtree> chosen, Border const& border,
                       Front const& front) noexcept {
    auto const update_of = [&](Index node) { return dense::update_entries(border(node)); };
    auto const is_root = [&](Index node) {
        for (Subtree const& subtree : chosen.first(count)) {
            if (subtree.root == node) return true;
        }
        return false;
    };
    kept_entries = kept_rows = stack_entries = top_stack_entries = stack_rows = 0;
    for (Index k = 0; k < count; ++k) {
        if (!all.empty()) {
            all[k].kept = kept_entries;
            all[k].kept_rows = kept_rows;
        }
        kept_entries += update_of(chosen[k].root);
        kept_rows += front(chosen[k].root);
    }
    for (Index node = 0; node < tree.count; ++node) {
        bool const is_leaf = tree.nodes[node].child == none, ends_subtree = is_root(node);
        if (!is_leaf && !ends_subtree) continue;
        // The sums along the path to the root: `inside` a subtree, `above` it, and `rows` in both.
        Offset inside = 0, above = 0, rows = 0;
        bool in_subtree = !ends_subtree && count > 0;
        for (Index up = node; up != none; up = tree.nodes[up].parent) {
            rows += front(up);
            if (in_subtree && is_root(up)) {
                in_subtree = false;  // The update matrix of the subtree's root is kept elsewhere.
            } else if (up != node || !ends_subtree) {
                (in_subtree ? inside : above) += update_of(up);
            }
        }
        // A leaf with no root of a subtree on the path to the root lies itself above all subtrees.
        if (in_subtree) {
            above = inside;
            inside = 0;
        }
        stack_entries = max(stack_entries, inside);
        top_stack_entries = max(top_stack_entries, above);
        stack_rows = max(stack_rows, rows);
    }
}

}  // namespace harmorph
