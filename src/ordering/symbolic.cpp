#include "ordering/symbolic.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

// All borders that contain a position of a subtree belong to nodes of the same subtree, so subtrees
// can be walked at the same time.
SubtreeRanges ranges_for(Executor const& executor, AssemblyTree const& tree, Index n) noexcept {
    SubtreeRanges ranges;
    if (!executor.is_serial()) ranges.choose(tree, n / (8 * executor.n_threads));
    return ranges;
}

// Calls visit(range) for the subtrees on the executor's threads, then for the rest on the calling
// thread.
template <class Visit>
void for_each_range(SubtreeRanges const& ranges, Index n, Executor const& executor,
                    Visit const& visit) noexcept {
    executor.for_each(ranges.count, [&](Index i) { visit(ranges.subtree[i]); });
    ranges.for_each_between(n, visit);
}

// Calls visit(position, node) for every position of nodes that have children; the positions of the
// other nodes are in no border.
template <class Visit>
void for_each_above_leaves(AssemblyTree const& tree, Index first, PositionRange range,
                           Visit visit) noexcept {
    for (Index t = first; t < tree.count && tree.nodes[t].begin < range.end; ++t) {
        AssemblyTree::Node const node = tree.nodes[t];
        for (Index position = node.begin; node.child != none && position < node.end; ++position)
            visit(position, t);
    }
}

// Calls visit(node, position) for every node whose border contains the position, and then
// visit(none, position). These are the nodes on the tree's paths from the position's earlier
// neighbours up to the position's own node (J. W. H. Liu's row subtrees, ACM Trans. Math. Softw. 12
// (1986) 127). Each node sees positions in increasing order, so each border is filled in order.
template <class Visit>
void walk(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
          BorderWork const& work, PositionRange range, Visit visit) noexcept {
    Span<const Index> const node_of = work.node;
    Span<BorderWork::Step> const step = work.step;
    for_each_above_leaves(tree, node_of[order[range.begin]], range, [&](Index position, Index own) {
        graph.prefetch_neighbours(order, position, range.end);
        for (Index const neighbour : graph.neighbours(order[position])) {
            for (Index node = node_of[neighbour]; node < own && step[node].seen != position;
                 node = step[node].parent) {
                step[node].seen = position;
                visit(node, position);
            }
        }
        visit(none, position);
    });
}

void restart(AssemblyTree const& tree, BorderWork const& work) noexcept {
    for (Index t = 0; t < tree.count; ++t) work.step[t] = {tree.nodes[t].parent, none, 0};
}

// The nodes that a walk through a range passes, stored in the range's section of
// BorderWork::passed. The first entry tells whether all nodes had room.
class Track {
public:
    Track(BorderWork const& work, PositionRange range) noexcept
        : numbers_(work.passed.data() + Offset{BorderWork::passed_per_position} * range.begin),
          room_(Offset{BorderWork::passed_per_position} * (range.end - range.begin)) {}

    void add(Index node) noexcept {
        if (next_ < room_) numbers_[next_] = node;
        ++next_;
    }
    void close() const noexcept { numbers_[0] = next_ <= room_ ? 1 : 0; }
    bool is_whole() const noexcept { return numbers_[0] != 0; }
    Index next() noexcept { return numbers_[next_++]; }

private:
    Index* const numbers_;  // The first number tells whether the others are complete.
    Offset const room_;
    Offset next_ = 1;
};

}  // namespace

void BorderWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(position, max_unknowns);
    arena.take(node, max_unknowns);
    arena.take(step, max_unknowns / 2 + 1);
}

void BorderWork::lay_out_passed(Arena& arena, Index max_unknowns) noexcept {
    arena.take(passed, Offset{passed_per_position} * max_unknowns);
}

FrontSizes count_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
                         BorderWork const& work, Executor const& executor,
                         Span<Offset> border_start) noexcept {
    executor.for_ranges(tree.count, 256, [&](Index begin, Index end) {
        for (Index t = begin; t < end; ++t) {
            for (Index k = tree.nodes[t].begin; k < tree.nodes[t].end; ++k) {
                work.node[order[k]] = t;
                work.position[order[k]] = k;
            }
        }
    });
    restart(tree, work);
    for_each_range(ranges_for(executor, tree, graph.n), graph.n, executor,
                   [&](PositionRange range) {
                       Track track(work, range);
                       walk(graph, order, tree, work, range, [&](Index node, Index) {
                           track.add(node);
                           if (node != none) ++work.step[node].filled;
                       });
                       track.close();
                   });

    FrontSizes sizes;
    for (Index t = 0; t < tree.count; ++t) {
        Index const pivots = tree.nodes[t].pivots(), border = work.step[t].filled;
        border_start[t] = sizes.border_entries;
        sizes.border_entries += border;
        sizes.factor_entries += dense::panel_entries(pivots, border);
        sizes.max_sums = max(sizes.max_sums, dense::sum_entries(pivots, border));
    }
    border_start[tree.count] = sizes.border_entries;
    return sizes;
}

void fill_borders(Graph const& graph, Span<const Index> order, AssemblyTree const& tree,
                  BorderWork const& work, Executor const& executor, Span<const Offset> border_start,
                  Span<Index> border) noexcept {
    restart(tree, work);
    auto const enter = [&](Index node, Index position) {
        if (node != none) border[border_start[node] + work.step[node].filled++] = position;
    };
    for_each_range(ranges_for(executor, tree, graph.n), graph.n, {}, [&](PositionRange range) {
        Track track(work, range);
        if (!track.is_whole()) return walk(graph, order, tree, work, range, enter);
        for_each_above_leaves(tree, work.node[order[range.begin]], range,
                              [&](Index position, Index) {
                                  for (Index node = track.next(); node != none; node = track.next())
                                      enter(node, position);
                              });
    });
}

}  // namespace harmorph
