#include "ordering/subtrees.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

class Costs {
public:
    Costs(AssemblyTree const& tree, Span<const Offset> border_start) noexcept
        : tree_(tree), border_start_(border_start) {}

    Index border(Index node) const noexcept {
        return static_cast<Index>(border_start_[node + 1] - border_start_[node]);
    }
    Index front(Index node) const noexcept { return tree_.nodes[node].pivots() + border(node); }

    Subtree subtree(Index root) const noexcept {
        Subtree out;
        out.first = out.root = root;
        while (tree_.nodes[out.first].child != none) out.first = tree_.nodes[out.first].child;
        for (Index node = out.first; node <= root; ++node) {
            out.work += Offset{tree_.nodes[node].pivots()} * front(node) * front(node);
        }
        return out;
    }

private:
    AssemblyTree const& tree_;
    Span<const Offset> border_start_;
};

}  // namespace

void Subtrees::lay_out(Arena& arena, Index n_workers) noexcept {
    workers = n_workers;
    arena.take(all, max_count(workers));
}

Index Subtrees::find(Index node) const noexcept {
    Index low = 0, high = count;
    while (low < high) {
        Index const middle = low + (high - low) / 2;
        if (all[middle].root < node) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < count && all[low].root == node ? low : none;
}

void Subtrees::choose(AssemblyTree const& tree, Span<const Offset> border_start) noexcept {
    count = 0;
    if (workers > 1) split(tree, border_start);
    sort_by_work();

    Costs const costs(tree, border_start);
    measure(
        tree, all, [&](Index node) { return costs.border(node); },
        [&](Index node) { return costs.front(node); });
}

// Replaces the subtree with the most work by the subtrees of the children, until there are enough
// subtrees.
void Subtrees::split(AssemblyTree const& tree, Span<const Offset> border_start) noexcept {
    Costs const costs(tree, border_start);
    for (Index node = 0; node < tree.count && count < all.count(); ++node) {
        if (tree.nodes[node].parent == none) all[count++] = costs.subtree(node);
    }
    while (true) {
        Index largest = 0;
        for (Index i = 1; i < count; ++i) {
            if (all[i].work > all[largest].work) largest = i;
        }
        Index n_children = 0;
        for (Index child = tree.nodes[all[largest].root].child; child != none;
             child = tree.nodes[child].sibling) {
            ++n_children;
        }
        if (n_children == 0 || count + n_children - 1 > all.count()) break;
        Index child = tree.nodes[all[largest].root].child;
        all[largest] = costs.subtree(child);
        for (child = tree.nodes[child].sibling; child != none; child = tree.nodes[child].sibling) {
            all[count++] = costs.subtree(child);
        }
    }
}

// List scheduling: the largest subtree comes first, and each goes to the worker that is free next
// (R. L. Graham's LPT rule).
void Subtrees::sort_by_work() noexcept {
    Span<Subtree> const chosen = all.first(count);
    sort(chosen, [](Subtree const& a, Subtree const& b) { return a.root < b.root; });
    for (Index k = 0; k < count; ++k) {
        Index more = 0;  // The number of subtrees that come before this one.
        for (Index i = 0; i < count; ++i) {
            bool const equal = chosen[i].work == chosen[k].work;
            more += chosen[i].work > chosen[k].work || (equal && i < k) ? 1 : 0;
        }
        chosen[more].by_work = k;
    }
}

}  // namespace harmorph
