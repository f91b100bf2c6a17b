// Finds the cell of a mesh that contains a point, or the nearest cell, and the interpolation
// weights of the corners.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/topology.hpp"

namespace harmorph {

// Keeps items in a balanced tree of bounding boxes, and finds the item nearest to a point, or the
// items near a box.
struct Nearest {
    Index item = none;
    Real squared = infinity;  // the squared distance
};

// The tree is a complete binary tree: node 1 is the root, and node k has the children 2k and 2k +
// 1. Node j of level l contains the entries n j / 2^l .. n (j + 1) / 2^l - 1, so the structure
// follows from n alone, without pointers.
struct BoxTree {
    static constexpr Index max_levels = 31;

    struct Entry {
        Vec2 centre;
        Index item;
    };

    Index n = 0, levels = 0;
    Span<Entry> entry;  // [n] in the order of the tree
    Span<Box> box;      // [2^(levels + 1)]

    void lay_out(Arena& arena, Index n_items) noexcept;
    // Changes the number of items; the tree must have been laid out for at least as many.
    void set_count(Index n_items) noexcept;

    // Builds the tree from box_of(item) for the items 0 .. n-1. The entries of each node are
    // divided at the median of their centres in the direction in which the centres extend farther.
    template <class BoxOf>
    void build(BoxOf const& box_of) noexcept {
        for (Index item = 0; item < n; ++item) entry[item] = {box_of(item).centre(), item};
        halve();
        Index const leaves = Index{1} << levels;
        for (Index leaf = 0; leaf < leaves; ++leaf) {
            Box& leaf_box = box[leaves + leaf];
            leaf_box = {};
            Index const end = begin(levels, leaf + 1);
            for (Index k = begin(levels, leaf); k < end; ++k)
                leaf_box.include(box_of(entry[k].item));
        }
        unite();
    }

    // Returns the item with the smallest squared_distance(item) if it is nearer than `best`, and
    // `best` otherwise.
    template <class SquaredDistance>
    Nearest nearest(Vec2 point, Nearest best,
                    SquaredDistance const& squared_distance) const noexcept;

    // Calls visit(item) for all items whose boxes meet `around`, and for some others, in the order
    // of the tree.
    template <class Visit>
    void for_items_near(Box const& around, Visit const& visit) const noexcept;

private:
    Index begin(Index level, Index node) const noexcept {
        return static_cast<Index>((Offset{n} * node) >> level);
    }
    void halve() noexcept;
    void unite() noexcept;
};

template <class SquaredDistance>
Nearest BoxTree::nearest(Vec2 point, Nearest best,
                         SquaredDistance const& squared_distance) const noexcept {
    struct Waiting {
        Index node;
        Real squared;
    };
    Waiting waiting[max_levels + 1];
    Index const leaves = Index{1} << levels;
    Index n_waiting = 0;
    if (n > 0) waiting[n_waiting++] = {1, box[1].squared_distance(point)};
    while (n_waiting > 0) {
        Waiting const next = waiting[--n_waiting];
        if (!(next.squared < best.squared)) continue;
        Index node = next.node;
        while (node < leaves) {
            Waiting near{2 * node, box[2 * node].squared_distance(point)};
            Waiting far{2 * node + 1, box[2 * node + 1].squared_distance(point)};
            if (far.squared < near.squared) {
                Waiting const exchanged = near;
                near = far;
                far = exchanged;
            }
            if (far.squared < best.squared) waiting[n_waiting++] = far;
            if (!(near.squared < best.squared)) break;
            node = near.node;
        }
        if (node < leaves) continue;
        Index const leaf = node - leaves;
        for (Index k = begin(levels, leaf); k < begin(levels, leaf + 1); ++k) {
            Real const squared = squared_distance(entry[k].item);
            if (squared < best.squared) best = {entry[k].item, squared};
        }
    }
    return best;
}

template <class Visit>
void BoxTree::for_items_near(Box const& around, Visit const& visit) const noexcept {
    Index waiting[max_levels + 1];
    Index const leaves = Index{1} << levels;
    Index n_waiting = 0;
    if (n > 0) waiting[n_waiting++] = 1;
    while (n_waiting > 0) {
        Index const node = waiting[--n_waiting];
        if (!box[node].meets(around)) continue;
        if (node < leaves) {
            waiting[n_waiting++] = 2 * node + 1;
            waiting[n_waiting++] = 2 * node;
            continue;
        }
        Index const leaf = node - leaves;
        for (Index k = begin(levels, leaf); k < begin(levels, leaf + 1); ++k) visit(entry[k].item);
    }
}

// A linear field f has the value sum_k weight_k f(point_k) at the located point; the sum
// interpolates inside the cell and extrapolates outside. The weights add up to 1; at a point of the
// mesh, the weight of that point is exactly 1. In a quad, the weights are the mean over the two
// splits into triangles, as in the equations.
struct CellWeights {
    Index n = 0;
    Index point[4] = {};
    Real weight[4] = {};
};

// Computes the weights [n] of the corners of a cell at a point.
void weigh_corners(CellShape const& shape, Vec2 point, Real* weight) noexcept;

struct Location {
    Index cell = none;
    Real distance = 0;      // from the cell; 0 inside the cell, to rounding
    Real longest_side = 0;  // the length of the longest side of the cell
    CellWeights weights;
};

struct Locator {
    OrientedMesh cells;
    BoxTree tree;

    void lay_out(Arena& arena, Index n_cells) noexcept { tree.lay_out(arena, n_cells); }
    // The mesh must have no inverted cell.
    void build(OrientedMesh const& mesh) noexcept;

    // hint is a cell that probably contains the point, or none. A point on a common side of two
    // cells may be found in either cell.
    Location locate(Vec2 point, Index hint) const noexcept;

private:
    CellShape shape(Index cell) const noexcept {
        return {cells.cell(cell), cells.mesh.points, false};
    }
};

}  // namespace harmorph
