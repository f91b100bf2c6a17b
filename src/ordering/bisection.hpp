// Cuts parts of a graph in two, again and again.
#pragma once

#include "cut_search.hpp"

#include "harmorph/ordering/nested_dissection.hpp"

namespace harmorph {

// A part of the order, cut: its left part, its right one from `middle` on, its separator from `pivots` on.
struct Division {
    Index middle = 0, pivots = 0;
};

// Parts that do not overlap may be ordered at the same time: each keeps to its own places of the working arrays, and
// separators that are done with stand between their unknowns.
class Dissector {
public:
    static constexpr Index leaf_size = 24;      // parts up to this size are eliminated densely
    static constexpr Index smallest_child = 4;  // smaller parts join the separator; with it, nodes <= n / 2

    Dissector(Graph const& graph, DissectionWork const& work, Span<Index> order) noexcept
        : graph_(graph), work_(work), order_(order), search_(graph, work.where, order) {}

    // Makes the steps from a straight cut through everything a direction of their own.
    void find_across() const noexcept;
    // Orders the part begin .. end-1 and returns its root in the tree, or none if it is empty.
    Index dissect(Index begin, Index end, AssemblyTree& tree) const noexcept;
    Division divide(Index begin, Index end) const noexcept;

private:
    void close_off(Index begin, Index end, bool marks_border) const noexcept;
    Division partition(Cut const& cut, Index begin, Index end) const noexcept;
    Index set_sides(Cut const& cut, Index begin, Index end, Index& n_left, Index& n_right) const noexcept;
    void absorb(Index begin, Division& division) const noexcept;
    void sort_along(Cut const& cut, Index begin, Index end) const noexcept;

    Graph const& graph_;
    DissectionWork const& work_;
    Span<Index> order_;
    CutSearch search_;
};

}  // namespace harmorph
