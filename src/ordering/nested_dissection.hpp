// ordering: the order of elimination that keeps the factor sparse, and the sizes that follow from
// the order.
//
// Input: the topology with the kinds of points, and coordinates (only to choose cuts). Output: the
// graph of the unknowns that share a cell; an order of the unknowns; for the direct engine the
// assembly tree, the borders of fronts (symbolic) and the subtrees for threads. nested_dissection,
// with bisection and cut_coordinates, computes the order of the direct engine; the advancing front
// in graph.hpp gives the order of the iterative engines. Sources: A. George, SIAM J. Numer. Anal.
// 10 (1973) 345; J. W. H. Liu, SIAM Review 34 (1992) 82, on multifrontal methods; others in the
// files.
//
// Nested dissection on the coordinates gives the order of elimination and the tree in which the
// matrix is factored.
#pragma once

#include "ordering/cut_coordinates.hpp"
#include "ordering/graph.hpp"

namespace harmorph {

// The separator that follows from a cut through edges: the fewest unknowns that touch every edge of
// the cut.

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

// Nodes are numbered children before parents, so that a loop over them is a postorder. A node
// eliminates the unknowns at positions begin .. end-1 of the order: a separator, or a whole region
// that is too small to cut.
struct AssemblyTree {
    struct Node {
        Index begin = 0, end = 0;  // The pivots are the positions begin .. end-1.
        Index parent = none;
        Index child = none;  // The first child; the others follow by `sibling`.
        Index sibling = none;
        Index pivots() const noexcept { return end - begin; }
    };

    Span<Node> nodes;
    Index count = 0;

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // Adds a node above the roots `first` and `second`, which become children of the node if they
    // are not none. Returns the number of the node.
    Index add(Index begin, Index end, Index first, Index second) noexcept;
};

struct DissectionWork {
    struct Keyed {
        float key;
        Index unknown;
    };
    CutCoordinates coordinates;
    BorderCover cover;
    Span<Index> moved;  // [n]
    Span<Keyed> keyed;  // [n]

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
};

// Fills order [n] with the unknowns in the order of elimination. Source of the method: A. George,
// SIAM J. Numer. Anal. 10 (1973) 345. Cuts go through sampled medians: straight, between two layers
// or across them; the separator is the smallest vertex cover of the edges that are cut. For large
// regions the cut with the fewest estimated multiplications, borders included, is taken. Separators
// are sorted along the cut, so that the rows of a child front are runs of neighbours in the parent
// front. The order and the tree do not depend on the number of threads.
void dissect(Graph const& graph, Points points, DissectionWork const& work,
             Executor const& executor, Span<Index> order, AssemblyTree& tree) noexcept;

}  // namespace harmorph
