// ordering: the order of elimination that keeps the factor sparse, and the sizes that follow from
// the order.
//
// Input: the topology with the kinds of points, and coordinates (only to choose cuts). Output: the
// graph of the unknowns that share a cell; an order of the unknowns; for the direct engine the
// assembly tree, the borders of fronts (symbolic) and the subtrees for threads. nested_dissection,
// with bisection, cut_coordinates, cut_search and vertex_cover, computes the order of the direct
// engine, advancing_front that of the iterative ones. Sources: A. George, SIAM J. Numer. Anal. 10
// (1973) 345; J. W. H. Liu, SIAM Review 34 (1992) 82, on multifrontal methods; others in the files.
//
// This file: nested dissection on the coordinates, which gives the order of elimination and the
// tree in which the matrix is factored.
#pragma once

#include "ordering/vertex_cover.hpp"
#include "ordering/cut_coordinates.hpp"

namespace harmorph {

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
