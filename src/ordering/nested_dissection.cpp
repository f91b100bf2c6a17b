#include "ordering/nested_dissection.hpp"

#include "base/executor.hpp"
#include "ordering/bisection.hpp"

namespace harmorph {

void BorderCover::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(side, max_unknowns);
    arena.take(mate, max_unknowns);
    arena.take(from, max_unknowns);
}

// Matches one more left unknown by exchanging the partners along a path to a free right unknown. If
// there is no such path, later searches need not visit the unknowns that this search visited.
// Returns how many unknowns the search visited.
Offset BorderCover::search(Graph const& graph, Index root, Span<Index> queue) const noexcept {
    Index filled = 0;
    queue[filled++] = root;
    for (Index read = 0; read < filled; ++read) {
        Index const u = queue[read];
        for (Index const v : graph.neighbours(u)) {
            if (side[v] != Side::right) continue;
            side[v] = Side::reached;
            from[v] = u;
            if (mate[v] != none) {
                queue[filled++] = mate[v];
                continue;
            }
            for (Index end = v; end != none;) {
                Index const left = from[end], before = mate[left];
                mate[end] = left;
                mate[left] = end;
                end = left != root ? before : none;
            }
            for (Index const left : queue.first(filled)) side[mate[left]] = Side::right;
            return filled;
        }
    }
    for (Index const left : queue.first(filled)) side[left] = Side::kept;
    return filled;
}

void BorderCover::find(Graph const& graph, Span<const Index> near,
                       Span<Index> queue) const noexcept {
    // Searches may visit so many unknowns on average for each near unknown; nearly all visit one.
    constexpr Offset visits_each = 16;
    for (Index const u : near) mate[u] = none;
    Offset visits_left = visits_each * near.count();
    for (Index const u : near) {
        if (side[u] != Side::left) continue;
        if (visits_left > 0) {
            visits_left -= search(graph, u, queue);
            continue;
        }
        for (Index const v : graph.neighbours(u)) {
            if (side[v] == Side::right) mate[u] = v;
        }
    }
    for (Index const u : near) {
        bool const uncovered = side[u] == Side::left && mate[u] != none;
        if (uncovered || side[u] == Side::reached) side[u] = Side::separator;
        if (side[u] == Side::kept) side[u] = Side::left;
    }
}

namespace {

// The top of the tree. Regions are cut level by level until there is a region for every thread.
// Then each task takes one region after the other; a task that cuts a region makes both sides ready
// for all tasks. The tree is the same for any number of levels.
class TreeTop {
public:
    TreeTop(Dissector const& dissector, Executor const& executor, AssemblyTree& tree) noexcept
        : dissector_(dissector), executor_(executor), tree_(tree) {}

    void dissect(Index n) noexcept {
        Index const threads = executor_.is_serial() ? 1 : executor_.n_threads;
        while (threads > 1 && levels_ < max_levels && (1 << levels_) < 8 * threads) ++levels_;
        regions_[1] = {0, n};
        Index level = 0;
        for (; level < levels_ && (1 << level) < threads; ++level) {
            executor_.for_each(1 << level, [&](Index i) { divide((1 << level) + i); });
        }
        for (Index h = 1; h < (2 << level); ++h) {
            if (!regions_[h].is_cut) ready_.add(h);
        }
        executor_.for_each(sharing(threads), [&](Index) {
            for (Index h = ready_.take(); h != none; h = ready_.take()) advance(h);
        });
        tree_.count = 0;
        join(1);
    }

private:
    static constexpr Index max_levels = 6;

    struct Region {
        Index begin = 0, end = 0;
        bool is_cut = false;
        // If a region h is cut, the separator begins here, and the regions 2 h and 2 h + 1 come
        // before it.
        Index pivots = 0;
        Index n_nodes = 0;  // The number of nodes of a region that is not cut.
        // A region of at least Dissector::smallest_child unknowns has at most half as many nodes as
        // unknowns.
        Index first_node() const noexcept { return (begin + 1) / 2; }
    };

    void divide(Index h) noexcept {
        Region& region = regions_[h];
        if (region.end - region.begin <= Dissector::leaf_size) return;
        DividedRange const division = dissector_.divide(region.begin, region.end);
        region.is_cut = true;
        region.pivots = division.pivots;
        regions_[2 * h] = {region.begin, division.middle};
        regions_[2 * h + 1] = {division.middle, division.pivots};
    }

    void advance(Index h) noexcept {
        if (h < (1 << levels_)) divide(h);
        if (!regions_[h].is_cut) return dissect_uncut(regions_[h]);
        ready_.add(2 * h);
        ready_.add(2 * h + 1);
    }

    void dissect_uncut(Region& region) const noexcept {
        if (region.begin == region.end) return;
        AssemblyTree own;
        own.nodes =
            tree_.nodes.from(region.first_node(), tree_.nodes.count() - region.first_node());
        dissector_.dissect(region.begin, region.end, own);
        region.n_nodes = own.count;
    }

    // Moves the nodes of all regions together, children before parents. Returns the root.
    Index join(Index h) noexcept {
        Region const& region = regions_[h];
        if (region.is_cut) {
            Index const first = join(2 * h), second = join(2 * h + 1);
            return tree_.add(region.pivots, region.end, first, second);
        }
        Index const shift = tree_.count;
        for (Index k = 0; k < region.n_nodes; ++k) {
            AssemblyTree::Node node = tree_.nodes[region.first_node() + k];
            Index* const relatives[] = {&node.parent, &node.child, &node.sibling};
            for (Index* const other : relatives) *other += *other != none ? shift : 0;
            tree_.nodes[tree_.count++] = node;
        }
        return region.n_nodes > 0 ? tree_.count - 1 : none;
    }

    Dissector const& dissector_;
    Executor const& executor_;
    AssemblyTree& tree_;
    Index levels_ = 0;  // Regions of this level are not cut here.
    Region regions_[2 << max_levels];
    ReadyItems<(2 << max_levels)> ready_;
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

void AssemblyTree::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(nodes, max_unknowns / 2 + 1);
}

void DissectionWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    coordinates.lay_out(arena, max_unknowns);
    cover.lay_out(arena, max_unknowns);
    arena.take(moved, max_unknowns);
    auto const shared = arena.mark();
    coordinates.lay_out_layers(arena, max_unknowns);
    arena.release(shared);
    arena.take(keyed, max_unknowns);
}

void dissect(Graph const& graph, Points points, DissectionWork const& work,
             Executor const& executor, Span<Index> order, AssemblyTree& tree) noexcept {
    work.coordinates.place(graph, points, executor);
    fill(work.cover.side.first(graph.n), Side::inside);
    Dissector const dissector(graph, work, order);
    executor.for_each(2, [&](Index search) {
        if (search == 0) work.coordinates.find_layers(graph);
        if (search == 1) dissector.find_across();
    });
    work.coordinates.keep_searches(graph, executor);
    for (Index u = 0; u < graph.n; ++u) order[u] = u;
    TreeTop(dissector, executor, tree).dissect(graph.n);
}

}  // namespace harmorph
