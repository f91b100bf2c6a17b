// Nested dissection on the coordinates: the order of elimination, and the tree in which the matrix is factored.
#pragma once

#include "harmorph/ordering/vertex_cover.hpp"
#include "harmorph/ordering/cut_coordinates.hpp"

namespace harmorph {

// Nodes are numbered children before parents, so that a loop over them is a postorder. A node eliminates the unknowns at
// positions begin .. end-1 of the order: a separator, or a whole part that is too small to cut.
struct AssemblyTree {
    struct Node {
        Index begin = 0, end = 0;  // pivots
        Index parent = none;
        Index child = none;        // the first; the others follow by `sibling`
        Index sibling = none;
        Index pivots() const noexcept { return end - begin; }
    };

    Span<Node> nodes;
    Index count = 0;

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
    // A node over roots of the tree that become its children, where they are not none. Returns its number.
    Index add(Index begin, Index end, Index first, Index second) noexcept;
};

struct DissectionWork {
    struct Keyed {
        float key;
        Index unknown;
    };
    Places where;
    BorderCover cover;
    Span<Index> moved;    // [n]
    Span<Keyed> keyed;    // [n]

    void lay_out(Arena& arena, Index max_unknowns) noexcept;
};

// order [n]: the unknowns in the order of elimination. Source of the method: A. George, SIAM J. Numer. Anal. 10 (1973) 345,
// with cuts through sampled medians, straight, between two layers or across them, and the smallest cover of the edges cut.
// Cuts of large parts are chosen by the multiplications that they lead to, with what borders on separators above.
// Separators are in order along the cut, so that fronts meet in runs of neighbours. Order and tree do not depend on the
// number of threads.
void dissect(Graph const& graph, Points points, DissectionWork const& work, Executor const& executor, Span<Index> order,
             AssemblyTree& tree) noexcept;

}  // namespace harmorph
