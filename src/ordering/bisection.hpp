// Recursive bisection: regions of a graph are cut in two by separators. A region is a range of the
// order. tests/ordering/test_nested_dissection.cpp covers this file.
#pragma once

#include "ordering/cut_coordinates.hpp"
#include "ordering/nested_dissection.hpp"

namespace harmorph {

// The search for the cut that divides a region in two.
struct Cut {
    Index direction = none;  // If the direction is none, the list is halved as it stands.
    float level = 0;
};

// The numbers of unknowns on both sides of a cut and in the separator.
struct CutSizes {
    // Regions of at least this size lead to most of the multiplications: a more exact estimate of
    // the cost is worth the time there.
    static constexpr Index large = 1 << 16;

    Index left = 0, right = 0, separator = 0;
    // The unknowns next to separators above, which are counted only if the region is
    // large.
    Index left_border = 0, right_border = 0;

    Index size() const noexcept { return left + right + separator; }
    Real cost() const noexcept;
    // Tells whether the separator is longer, by this factor, than a separator through a square
    // region.
    bool is_longer(Real factor) const noexcept {
        return Real{1} * separator * separator > factor * factor * size();
    }
};

// Searches in regions of the order that do not overlap may run at the same time.
class CutSearch {
public:
    CutSearch(Graph const& graph, CutCoordinates const& coordinates,
              Span<const Index> order) noexcept
        : graph_(graph), coordinates_(coordinates), order_(order) {}

    // Returns the straight cut, in one of the directions 0 .. n_directions-1, with the lowest
    // estimated cost.
    Cut best(Index begin, Index end, Index n_directions) const noexcept;
    // Finds the cut after the level that costs least, if the cost is less than `max_cost`. In
    // strongly stretched or curved cells straight cuts run obliquely through thousands of cells;
    // steps from cell to cell do not depend on the shape of the cells.
    bool find_level_cut(Real max_cost, Index begin, Index end, Cut& cut) const noexcept;
    // Returns how many unknowns of order [begin .. end-1] are next to separators above, or 0 if a
    // region of this size is not large.
    Index border(Index begin, Index end, Index size) const noexcept;

private:
    struct Counts;

    template <bool is_large>
    Cut best_of(Index begin, Index end, Index n_directions) const noexcept;
    void set_medians(Index begin, Index n, float* level) const noexcept;

    Graph const& graph_;
    CutCoordinates const& coordinates_;
    Span<const Index> order_;
};

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
