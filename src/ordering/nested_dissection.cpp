#include "harmorph/ordering/nested_dissection.hpp"

#include "bisection.hpp"

namespace harmorph {
namespace {

// The top of the tree, cut level by level; then every part that is left is a task. The same tree for any number of levels.
class TreeTop {
public:
    TreeTop(Dissector const& dissector, Executor const& executor, AssemblyTree& tree) noexcept
        : dissector_(dissector), executor_(executor), tree_(tree) {}

    void dissect(Index n) noexcept {
        Index levels = 0;
        while (!executor_.is_serial() && levels < most_levels && (1 << levels) < 8 * executor_.n_threads) ++levels;
        part_[1] = {0, n};
        for (Index level = 0; level < levels; ++level) {
            executor_.for_each(1 << level, [&](Index i) { divide((1 << level) + i); });
        }
        executor_.for_each((2 << levels) - 1, [&](Index i) { plant(part_[1 + i]); });
        tree_.count = 0;
        join(1);
    }

private:
    static constexpr Index most_levels = 6;

    struct Part {
        Index begin = 0, end = 0;
        bool is_cut = false;
        Index pivots = 0;   // where it is cut, the parts 2 h and 2 h + 1 of part h before them
        Index n_nodes = 0;  // where not
        // No part of at least Dissector::smallest_child unknowns has more nodes than half of them.
        Index first_node() const noexcept { return (begin + 1) / 2; }
    };

    void divide(Index h) noexcept {
        Part& its = part_[h];
        if (its.end - its.begin <= Dissector::leaf_size) return;
        Division const division = dissector_.divide(its.begin, its.end);
        its.is_cut = true;
        its.pivots = division.pivots;
        part_[2 * h] = {its.begin, division.middle};
        part_[2 * h + 1] = {division.middle, division.pivots};
    }

    void plant(Part& its) const noexcept {
        if (its.is_cut || its.begin == its.end) return;
        AssemblyTree own;
        own.nodes = tree_.nodes.from(its.first_node(), tree_.nodes.count() - its.first_node());
        dissector_.dissect(its.begin, its.end, own);
        its.n_nodes = own.count;
    }

    // Moves nodes up to those that are there already. Returns the root.
    Index join(Index h) noexcept {
        Part const& its = part_[h];
        if (its.is_cut) {
            Index const first = join(2 * h), second = join(2 * h + 1);
            return tree_.add(its.pivots, its.end, first, second);
        }
        Index const shift = tree_.count;
        for (Index k = 0; k < its.n_nodes; ++k) {
            AssemblyTree::Node node = tree_.nodes[its.first_node() + k];
            Index* const relatives[] = {&node.parent, &node.child, &node.sibling};
            for (Index* const other : relatives) *other += *other != none ? shift : 0;
            tree_.nodes[tree_.count++] = node;
        }
        return its.n_nodes > 0 ? tree_.count - 1 : none;
    }

    Dissector const& dissector_;
    Executor const& executor_;
    AssemblyTree& tree_;
    Part part_[2 << most_levels];
};

}  // namespace

Index AssemblyTree::add(Index begin, Index end, Index first, Index second) noexcept {
    Index const number = count++;
    Node node;
    node.begin = begin;
    node.end = end;
    node.child = first != none ? first : second;
    if (first != none && second != none) nodes[first].sibling = second;
    Index const children[] = {first, second};
    for (Index const child : children) {
        if (child != none) nodes[child].parent = number;
    }
    nodes[number] = node;
    return number;
}

void AssemblyTree::lay_out(Arena& arena, Index max_unknowns) noexcept { arena.take(nodes, max_unknowns / 2 + 1); }

void DissectionWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    where.lay_out(arena, max_unknowns);
    cover.lay_out(arena, max_unknowns);
    arena.take(moved, max_unknowns);
    arena.take(keyed, max_unknowns);
}

void dissect(Graph const& graph, Points points, DissectionWork const& work, Executor const& executor, Span<Index> order,
             AssemblyTree& tree) noexcept {
    work.where.find(graph, points, executor);
    fill(work.cover.side.first(graph.n), Side::inside);
    Dissector const dissector(graph, work, order);
    dissector.find_across();
    for (Index u = 0; u < graph.n; ++u) order[u] = u;
    TreeTop(dissector, executor, tree).dissect(graph.n);
}

}  // namespace harmorph
