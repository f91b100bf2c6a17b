// Recursive bisection: regions of a graph are cut in two by separators. A region is a range of the
// order. tests/ordering/test_nested_dissection.cpp covers this file.
#pragma once

#include "ordering/cut_search.hpp"

#include "ordering/nested_dissection.hpp"

namespace harmorph {

// A region of the order after a cut: the left side, then the right side, which begins at `middle`,
// then the separator, which begins at `pivots`.
struct DividedRange {
    Index middle = 0, pivots = 0;
};

// Regions that do not overlap may be ordered at the same time. Each uses only the range of the
// working arrays that is the range of the region, and no unknowns of two regions are neighbours, as
// separators lie between them.
class Dissector {
public:
    // Regions up to this size are eliminated as dense matrices.
    static constexpr Index leaf_size = 24;
    // Smaller sides join the separator, so that there are at most n / 2 nodes.
    static constexpr Index smallest_child = 4;

    Dissector(Graph const& graph, DissectionWork const& work, Span<Index> order) noexcept
        : graph_(graph), work_(work), order_(order), search_(graph, work.coordinates, order) {}

    // Cuts the whole graph once by a straight cut, and makes the number of steps from this cut one
    // more coordinate.
    void find_across() const noexcept;
    // Orders the region begin .. end-1 and returns the root of the region in the tree, or none if
    // the region is empty.
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
