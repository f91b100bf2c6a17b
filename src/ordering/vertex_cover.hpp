// From a cut through edges to a separator: the fewest unknowns that touch every edge of the cut.
#pragma once

#include "ordering/graph.hpp"

namespace harmorph {

// The state of an unknown in a dissection. While a part is cut, only unknowns near the cut are
// `left` or `right`.
enum class Side : std::uint8_t {
    inside,  // in a part, not near a cut
    left,
    right,
    separator,
    elsewhere,  // in a separator above
    reached,    // while the cover is computed: a right unknown that the search has reached, ...
    kept        // ... and a left one that is not in the cover
};

struct BorderCover {
    Span<Side> side;   // [n] of each unknown
    Span<Index> mate;  // [n] the partner of each unknown in the matching, or none
    Span<Index> from;  // [n] the unknown from which the search reached each unknown

    void lay_out(Arena& arena, Index max_unknowns) noexcept;

    // near: all unknowns on a side that have a neighbour on the other, and perhaps more; queue
    // [near]. Those of a smallest cover become the separator. (By a largest matching of the two
    // borders: D. Koenig's theorem; A. Pothen, C.-J. Fan, ACM Trans. Math. Softw. 16 (1990) 303. On
    // graphs where that would take long: by a large one.)
    void find(Graph const& graph, Span<const Index> near, Span<Index> queue) const noexcept;

private:
    Offset search(Graph const& graph, Index root, Span<Index> queue) const noexcept;
};

}  // namespace harmorph
