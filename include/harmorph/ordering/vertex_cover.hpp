// From a cut through edges to a separator: the fewest unknowns that touch every edge of the cut.
#pragma once

#include "harmorph/ordering/graph.hpp"

namespace harmorph {

// What a dissection knows of an unknown. Of those of a part that is being cut, only such as are near the cut are on a side.
enum class Side : std::uint8_t {
    inside,     // of its part
    left, right,
    separator,
    elsewhere,  // done with: in a separator above
    reached,    // while borders are covered: a right unknown that the search has come to, ...
    kept        // ... and a left one that the cover does without
};

struct BorderCover {
    Span<Side> side;    // [n] of each unknown
    Span<Index> mate;   // [n] its partner in the matching, or none
    Span<Index> from;   // [n] whence the search came to it

    void lay_out(Arena& arena, Index max_unknowns) noexcept;

    // near: all unknowns on a side that have a neighbour on the other, and perhaps more; queue [near]. Those of a smallest
    // cover become the separator. (By a largest matching of the two borders: D. Koenig's theorem; A. Pothen, C.-J. Fan,
    // ACM Trans. Math. Softw. 16 (1990) 303. On graphs where that would take long: by a large one.)
    void find(Graph const& graph, Span<const Index> near, Span<Index> queue) const noexcept;

private:
    Offset search(Graph const& graph, Index root, Span<Index> queue) const noexcept;
};

}  // namespace harmorph
