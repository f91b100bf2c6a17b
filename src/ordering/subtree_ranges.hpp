// The positions of disjoint subtrees of the assembly tree. No unknown of one subtree has a
// neighbour in another one, so work that concerns an unknown and its earlier neighbours can be done
// in all subtrees at the same time. The positions between them, which are separators, come
// afterwards.
#pragma once

#include "base/executor.hpp"
#include "ordering/nested_dissection.hpp"

namespace harmorph {

struct PositionRange {
    Index begin = 0, end = 0;
};

struct SubtreeRanges {
    static constexpr Index max_count = 256;

    Index count = 0;
    PositionRange subtree[max_count];  // The ranges are in increasing order.

    // Chooses at most `max_subtrees` subtrees of at most `max_size` positions each; max_subtrees <=
    // max_count.
    void choose(AssemblyTree const& tree, Index max_size, Index max_subtrees = max_count) noexcept {
        count = 0;
        if (tree.count > 0) add(tree, tree.count - 1, max_size, max_subtrees);
    }
    // Calls visit(range) for the ranges between the subtrees; these ranges and the subtrees
    // together cover 0 .. n-1.
    template <class Visit>
    void for_each_between(Index n, Visit const& visit) const noexcept {
        Index begin = 0;
        for (PositionRange const& done :
             Span<const PositionRange>(subtree, static_cast<Size>(count))) {
            if (begin < done.begin) visit(PositionRange{begin, done.begin});
            begin = done.end;
        }
        if (begin < n) visit(PositionRange{begin, n});
    }

private:
    void add(AssemblyTree const& tree, Index root, Index max_size, Index max_subtrees) noexcept {
        Index first = root;
        while (tree.nodes[first].child != none) first = tree.nodes[first].child;
        PositionRange const positions{tree.nodes[first].begin, tree.nodes[root].end};
        if (positions.end - positions.begin <= max_size && count < max_subtrees) {
            subtree[count++] = positions;
            return;
        }
        for (Index child = tree.nodes[root].child; child != none;
             child = tree.nodes[child].sibling) {
            add(tree, child, max_size, max_subtrees);
        }
    }
};

}  // namespace harmorph
