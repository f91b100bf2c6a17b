// The separator that follows from a cut through edges: the fewest unknowns that touch every edge of
// the cut.
#pragma once

#include "ordering/graph.hpp"

namespace harmorph {

// The state of an unknown in a dissection. While a region is cut, only unknowns near the cut are
// `left` or `right`.
enum class Side : std::uint8_t {
    inside,  // The unknown is in a region, not near a cut.
    left,
    right,
    separator,
    elsewhere,  // The unknown is in a separator above.
    reached,    // A search for the cover has reached the unknown, which is on the right.
    kept        // A search found that the unknown, which is on the left, is not in the cover.
};

struct BorderCover {
    Span<Side> side;   // [n] The side of each unknown.
    Span<Index> mate;  // [n] The partner of each unknown in the matching, or none.
    Span<Index> from;  // [n] The unknown from which the search reached each unknown.

    void lay_out(Arena& arena, Index max_unknowns) noexcept;

    // Makes the unknowns of a smallest cover the separator. `near` contains all unknowns on a side
    // that have a neighbour on the other, and perhaps more; queue [near] is working space. The
    // cover follows from a largest matching of the two borders (D. Koenig's theorem; A. Pothen,
    // C.-J. Fan, ACM Trans. Math. Softw. 16 (1990) 303), or from a large matching on graphs for
    // which the largest one would take long.
    void find(Graph const& graph, Span<const Index> near, Span<Index> queue) const noexcept;

private:
    Offset search(Graph const& graph, Index root, Span<Index> queue) const noexcept;
};

}  // namespace harmorph
