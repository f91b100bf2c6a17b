#include "harmorph/fronts.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

// Subtrees with a small share of the positions each. All nodes that positions in one of them touch are in it, too.
struct SmallSubtrees {
    struct Range {
        Index begin, end;  // positions
    };
    static constexpr Index most = 256;
    Index count = 0;
    Range range[most];

    // In the order of positions.
    void add(AssemblyTree const& tree, Index root, Index largest) noexcept {
        Index first = root;
        while (tree.nodes[first].child != none) first = tree.nodes[first].child;
        Range const its{tree.nodes[first].begin, tree.nodes[root].end};
        if (its.end - its.begin <= largest && count < most) {
            range[count++] = its;
            return;
        }
        for (Index child = tree.nodes[root].child; child != none; child = tree.nodes[child].sibling) add(tree, child, largest);
    }
};

// visit(node, position) for every node whose border holds the position: the nodes on the tree's paths from the position's
// earlier neighbours up to its own node (J. W. H. Liu's row subtrees, ACM Trans. Math. Softw. 12 (1986) 127).
// To each node positions come in increasing order, so each border is filled in order.
template <class Visit>
void for_each_border_entry(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                           Executor const& executor, Visit visit) noexcept {
    auto const walk = [&](Index begin, Index end) {
        for (Index position = begin; position < end; ++position) {
            Index const own = work.node[position];
            for (Index const neighbour : graph.of(order[position])) {
                Index const earlier = work.position[neighbour];
                if (earlier >= position) continue;
                Index node = work.node[earlier];
                for (; node != own && work.seen[node] != position; node = tree.nodes[node].parent) {
                    work.seen[node] = position;
                    visit(node, position);
                }
            }
        }
    };
    fill(work.seen.first(tree.count), none);
    SmallSubtrees subtrees;
    if (!executor.is_serial()) subtrees.add(tree, tree.count - 1, graph.n / (8 * executor.n_threads));
    executor.for_each(subtrees.count, [&](Index i) { walk(subtrees.range[i].begin, subtrees.range[i].end); });
    Index begin = 0;
    for (Index i = 0; i < subtrees.count; ++i) {  // what is between them
        walk(begin, subtrees.range[i].begin);
        begin = subtrees.range[i].end;
    }
    walk(begin, graph.n);
}

}  // namespace

void BorderWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(node, max_unknowns);
    arena.take(position, max_unknowns);
    arena.take(seen, max_unknowns / 2 + 1);
    arena.take(filled, max_unknowns / 2 + 1);
}

FrontSizes count_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                         Executor const& executor, Span<Offset> border_start) noexcept {
    executor.for_ranges(tree.count, 256, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            for (Index k = tree.nodes[t].begin; k < tree.nodes[t].end; ++k) work.node[k] = t;
        }
    });
    executor.for_ranges(graph.n, 4096, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) work.position[order[k]] = k;
    });
    fill(border_start.first(tree.count + 1), Offset{0});
    for_each_border_entry(graph, order, tree, work, executor, [&](Index node, Index) { ++border_start[node]; });

    FrontSizes sizes;
    for (Index t = 0; t < tree.count; ++t) {
        Index const border = static_cast<Index>(border_start[t]);
        Index const front = tree.nodes[t].pivots() + border;
        sizes.border_entries += border;
        sizes.factor_entries += dense::panel_entries(tree.nodes[t].pivots(), front);
        sizes.largest_front = larger(sizes.largest_front, front);
        sizes.largest_border = larger(sizes.largest_border, border);
    }
    counts_to_starts(border_start.first(tree.count + 1));
    return sizes;
}

void fill_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree, BorderWork const& work,
                  Span<const Offset> border_start, Span<Index> border) noexcept {
    fill(work.filled.first(tree.count), Index{0});
    for_each_border_entry(graph, order, tree, work, {}, [&](Index node, Index position) {
        border[border_start[node] + work.filled[node]++] = position;
    });
}

}  // namespace harmorph
