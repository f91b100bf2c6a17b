// Recursive bisection: cuts parts of a graph in two by separators.
#pragma once

#include "ordering/cut_search.hpp"

#include "ordering/nested_dissection.hpp"

namespace harmorph {

// A part of the order after a cut: the left part, then the right part from `middle` on, then the
// separator from `pivots` on.
struct DividedRange {
    Index middle = 0, pivots = 0;
};

// Parts that do not overlap may be ordered at the same time: each uses only the range of the
// working arrays that is the range of the part, and no unknowns of two parts are neighbours, as
// separators lie between them.
class Dissector {
public:
    static constexpr Index leaf_size = 24;  // parts up to this size are eliminated densely
    static constexpr Index smallest_child =
        4;  // smaller parts join the separator; with it, nodes <= n / 2

    Dissector(Graph const& graph, DissectionWork const& work, Span<Index> order) noexcept
        : graph_(graph), work_(work), order_(order), search_(graph, work.coordinates, order) {}

    // Cuts the whole graph straight once, and makes the steps from this cut one more coordinate.
    void find_across() const noexcept;
    // Orders the part begin .. end-1 and returns its root in the tree, or none if it is empty.
    Index dissect(Index begin, Index end, AssemblyTree& tree) const noexcept;
    DividedRange divide(Index begin, Index end) const noexcept;

private:
    void close_off(Index begin, Index end, bool marks_border) const noexcept;
    DividedRange partition(Cut const& cut, Index begin, Index end) const noexcept;
    Index set_sides(Cut const& cut, Index begin, Index end, Index& n_left,
                    Index& n_right) const noexcept;
    void absorb(Index begin, DividedRange& division) const noexcept;
    void sort_along(Cut const& cut, Index begin, Index end) const noexcept;

    Graph const& graph_;
    DissectionWork const& work_;
    Span<Index> order_;
    CutSearch search_;
};

}  // namespace harmorph
