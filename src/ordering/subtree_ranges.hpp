// Positions of disjoint subtrees of the assembly tree. No unknown of one subtree has a neighbour in
// another one, so what concerns an unknown and its earlier neighbours can be done in all of them at
// the same time; the positions between them, which are separators, come afterwards.
#pragma once

#include "base/executor.hpp"
#include "ordering/nested_dissection.hpp"

namespace harmorph {

struct PositionRange {
    Index begin = 0, end = 0;
};

struct SubtreeRanges {
    static constexpr Index most = 256;

    Index count = 0;
    PositionRange subtree[most];  // increasing

    // At most `limit` subtrees of at most `largest` positions each, `limit` <= most.
    void choose(AssemblyTree const& tree, Index largest, Index limit = most) noexcept {
        count = 0;
        if (tree.count > 0) add(tree, tree.count - 1, largest, limit);
    }
    // visit(range) for the ranges between the subtrees, which are together 0 .. n-1 with these.
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
    void add(AssemblyTree const& tree, Index root, Index largest, Index limit) noexcept {
        Index first = root;
        while (tree.nodes[first].child != none) first = tree.nodes[first].child;
        PositionRange const positions{tree.nodes[first].begin, tree.nodes[root].end};
        if (positions.end - positions.begin <= largest && count < limit) {
            subtree[count++] = positions;
            return;
        }
        for (Index child = tree.nodes[root].child; child != none;
             child = tree.nodes[child].sibling) {
            add(tree, child, largest, limit);
        }
    }
};

}  // namespace harmorph
