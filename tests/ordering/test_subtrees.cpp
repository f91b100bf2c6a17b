// Subtrees are whole and apart, listed by work, and the memory laid out for them is what a walk
// through them needs.
#include <fixtures/graphs.hpp>

#include "ordering/subtrees.hpp"

using namespace fixtures;
using harmorph::Index;
using harmorph::none;
using harmorph::Offset;

namespace {

struct Chosen {
    std::vector<harmorph::Subtree> memory;
    harmorph::Subtrees subtrees;

    Chosen(Dissected const& cut, Symbolic const& symbolic, Index workers)
        : memory(std::size_t(harmorph::Subtrees::max_count(workers))) {
        subtrees.workers = workers;
        subtrees.all = span(memory);
        subtrees.choose(cut.tree, span(symbolic.start));
    }
};

// The factorisation's and the forward substitution's use of their stacks, node by node.
struct Walk {
    harmorph::AssemblyTree const& tree;
    Symbolic const& symbolic;
    harmorph::Subtrees const& subtrees;
    Offset stack[2] = {}, rows[2] = {};  // the most: inside a subtree, above all of them

    Index border(Index node) const {
        return Index(symbolic.start[std::size_t(node) + 1] - symbolic.start[std::size_t(node)]);
    }
    Offset update(Index node) const { return harmorph::dense::update_entries(border(node)); }
    Offset front(Index node) const { return tree.nodes[node].pivots() + border(node); }

    // `free` and `free_row`: where the node's children may be.
    void go(Index node, bool above, Offset free, Offset free_row) {
        stack[above] = std::max(stack[above], free);
        rows[above] = std::max(rows[above], free_row);
        for (Index child = tree.nodes[node].child; child != none; child = tree.nodes[child].sibling)
            if (subtrees.find(child) == none)
                go(child, above, free + update(child), free_row + front(child));
    }
};

bool is_below(harmorph::AssemblyTree const& tree, Index node, Index root) {
    while (node != none && node < root) node = tree.nodes[node].parent;
    return node == root;
}

}  // namespace

TEST_CASE("subtrees are whole, separate, in order, and listed by work") {
    for (HandMadeGraph& graph : nasty_graphs()) {
        Dissected const cut(graph);
        Symbolic const symbolic(graph, cut);
        for (Index const workers : {1, 2, 3, 8, 256}) {
            Chosen const chosen(cut, symbolic, workers);
            harmorph::Subtrees const& subtrees = chosen.subtrees;
            CHECK(subtrees.count <= harmorph::Subtrees::max_count(workers));
            CHECK((subtrees.count == 0) == (workers == 1));
            Offset kept = 0, kept_rows = 0;
            std::set<Index> listed;
            Walk walk{cut.tree, symbolic, subtrees};
            for (Index k = 0; k < subtrees.count; ++k) {
                harmorph::Subtree const& subtree = subtrees.all[k];
                harmorph::Subtree const& next =
                    subtrees.all[subtree.by_work];  // by decreasing work, each once
                if (k > 0) CHECK(next.work <= subtrees.all[subtrees.all[k - 1].by_work].work);
                CHECK(listed.insert(subtree.by_work).second);
                CHECK(subtree.first <= subtree.root);
                if (k > 0) CHECK(subtree.first > subtrees.all[k - 1].root);
                CHECK(subtrees.find(subtree.root) == k);
                for (Index node = 0; node < cut.tree.count; ++node) {
                    bool const in_range = node >= subtree.first && node <= subtree.root;
                    if (in_range != is_below(cut.tree, node, subtree.root)) CHECK(false);
                    if (in_range && node != subtree.root) CHECK(subtrees.find(node) == none);
                }
                CHECK(subtree.kept == kept);
                CHECK(subtree.kept_rows == kept_rows);
                kept += walk.update(subtree.root);
                kept_rows += walk.front(subtree.root);
                walk.go(subtree.root, false, 0, 0);
            }
            CHECK(subtrees.kept_entries == kept);
            CHECK(subtrees.kept_rows == kept_rows);

            Index const root = cut.tree.count - 1;
            if (subtrees.find(root) == none) walk.go(root, true, 0, walk.front(root));
            CHECK(subtrees.stack_entries >= walk.stack[0]);
            CHECK(subtrees.top_stack_entries >= walk.stack[1]);
            CHECK(subtrees.stack_rows >= std::max(walk.rows[0], walk.rows[1]));
            for (Index node = 0; node < cut.tree.count; ++node)
                CHECK(subtrees.stack_rows >= walk.front(node));  // going back down
            if (workers == 1)
                CHECK(subtrees.top_stack_entries == walk.stack[1]);  // and no more than that
            CHECK(subtrees.stack_entries == walk.stack[0]);
        }
    }
}

TEST_CASE("on a large mesh the work of all workers is similar") {
    HandMadeGraph graph = grid_graph(120, 110);
    Dissected const cut(graph);
    Symbolic const symbolic(graph, cut);
    for (Index const workers : {2, 4, 8, 16}) {
        Chosen const chosen(cut, symbolic, workers);
        std::vector<double> load(std::size_t(workers), 0.0);
        for (Index k = 0; k < chosen.subtrees.count; ++k) {  // to the one that is free next
            harmorph::Subtree const& subtree = chosen.subtrees.all[chosen.subtrees.all[k].by_work];
            *std::min_element(load.begin(), load.end()) += double(subtree.work);
        }
        auto const least = std::min_element(load.begin(), load.end()),
                   most = std::max_element(load.begin(), load.end());
        INFO(workers << " workers: " << *least << " to " << *most);
        CHECK(*least > 0);
        CHECK(*most < 1.6 * *least);
    }
}
