// The symbolic pass against brute force.
#include <fixtures/executors.hpp>
#include <fixtures/graphs.hpp>

using namespace fixtures;
using harmorph::Index;
using harmorph::Offset;

namespace {

// The later positions in which each column of the factor has entries, found by elimination with
// sets.
std::vector<std::set<Index>> eliminate(HandMadeGraph const& graph, Dissected const& cut) {
    std::vector<Index> const position = cut.position();
    std::vector<std::set<Index>> column(cut.order.size());
    for (std::size_t k = 0; k < cut.order.size(); ++k)
        for (std::int32_t const v : graph.near[std::size_t(cut.order[k])]) {
            Index const p = position[std::size_t(v)];
            if (p > Index(k)) column[k].insert(p);
        }
    for (std::size_t k = 0; k < column.size(); ++k) {
        if (column[k].empty()) continue;
        Index const parent = *column[k].begin();
        std::set<Index>& to = column[std::size_t(parent)];
        to.insert(std::next(column[k].begin()), column[k].end());
    }
    return column;
}

// Borders are what elimination fills, and nothing that no pivot of the subtree touches.
// Returns how many entries they have.
Offset check_borders(HandMadeGraph& graph) {
    Dissected const cut(graph);
    Symbolic const found(graph, cut);
    std::vector<std::set<Index>> const column = eliminate(graph, cut);
    INFO(graph.n() << " unknowns");
    Offset entries = 0;
    Index largest_front = 0;
    for (Index t = 0; t < cut.tree.count; ++t) {
        auto const& node = cut.tree.nodes[t];
        std::set<Index> filled, allowed;
        for (Index k = node.begin; k < node.end; ++k) {
            std::set<Index> const& below = column[std::size_t(k)];
            filled.insert(below.lower_bound(node.end), below.end());
        }
        // Dense fronts: what a child's border leaves behind belongs to the parent's, pivot or not.
        allowed = filled;
        for (Index child = node.child; child != -1; child = cut.tree.nodes[child].sibling) {
            std::set<Index> const border_of_child = found.border_of(child);
            allowed.insert(border_of_child.lower_bound(node.end), border_of_child.end());
        }
        std::set<Index> const border = found.border_of(t);
        CHECK(std::includes(border.begin(), border.end(), filled.begin(), filled.end()));
        CHECK(border == allowed);
        // Given in increasing order, each once.
        CHECK(border.size() ==
              std::size_t(found.start[std::size_t(t) + 1] - found.start[std::size_t(t)]));
        CHECK(std::is_sorted(found.border.begin() + found.start[std::size_t(t)],
                             found.border.begin() + found.start[std::size_t(t) + 1]));
        Index const size = Index(border.size());
        entries += size;
        largest_front = std::max(largest_front, size + node.pivots());
    }
    CHECK(found.sizes.border_entries == entries);
    CHECK(found.sizes.max_sums >= largest_front);
    CHECK(found.sizes.max_sums <= largest_front + 2 * (harmorph::dense::slab - 1));
    CHECK(found.border_of(cut.tree.count - 1).empty());  // nothing comes after the root
    return entries;
}

}  // namespace

TEST_CASE("borders are the fill of elimination and contain nothing else") {
    for (HandMadeGraph& graph : nasty_graphs()) check_borders(graph);
}

TEST_CASE("borders with more entries than are remembered are the same") {
    int const side = 40, hubs = 250;  // these end up above everything, and so in all borders
    HandMadeGraph graph = grid_graph(side, side);
    for (int hub = 0; hub < hubs; ++hub) {
        graph.add_point(side * (hub + 0.5) / hubs, 0.5 * side);
        for (int k = hub % 7; k < side * side; k += 7) graph.join(k, side * side + hub);
    }
    CHECK(check_borders(graph) > Offset{harmorph::BorderWork::passed_per_position} * graph.n());
}

TEST_CASE("any number of threads gives the same borders") {
    for (HandMadeGraph& graph : nasty_graphs()) {
        Dissected const cut(graph);
        Symbolic const alone(graph, cut);
        for (Index const threads : {2, 5}) {
            Backwards order;
            Symbolic const together(graph, cut, {Backwards::run, &order, threads});
            CHECK(together.start == alone.start);
            CHECK(together.border == alone.border);
            CHECK(together.sizes.factor_entries == alone.sizes.factor_entries);
        }
    }
}
