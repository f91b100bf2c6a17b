// The order of elimination is a permutation, its tree a postorder, and separators separate.
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/graphs.hpp>

#include <cstring>

using namespace fixtures;
using harmorph::Index;

namespace {

void check_dissection(HandMadeGraph& graph) {
    Dissected const cut(graph);
    std::int32_t const n = graph.n();
    INFO(n << " unknowns");

    std::vector<Index> const position = cut.position();
    for (Index const p : position) CHECK(p >= 0);   // each unknown once, as there are as many places

    // Nodes tile the order; children come before their parents and fill the places just before them.
    CHECK(cut.tree.count <= n / 2 + 1);
    Index next = 0, roots = 0;
    std::vector<Index> subtree_begin(static_cast<std::size_t>(cut.tree.count));
    std::vector<int> times_child(static_cast<std::size_t>(cut.tree.count), 0);
    for (Index t = 0; t < cut.tree.count; ++t) {
        auto const& node = cut.tree.nodes[t];
        CHECK(node.begin == next);
        CHECK(node.end >= node.begin);
        next = node.end;
        roots += node.parent == -1;
        if (node.parent != -1) CHECK(node.parent > t);
        Index begin = node.begin;
        for (Index child = node.child; child != -1; child = cut.tree.nodes[child].sibling) {
            REQUIRE(child < t);
            CHECK(cut.tree.nodes[child].parent == t);
            begin = std::min(begin, subtree_begin[static_cast<std::size_t>(child)]);
            ++times_child[static_cast<std::size_t>(child)];
        }
        subtree_begin[static_cast<std::size_t>(t)] = begin;
    }
    CHECK(next == n);
    CHECK(roots == 1);
    for (Index t = 0; t < cut.tree.count; ++t)
        CHECK(times_child[static_cast<std::size_t>(t)] == (cut.tree.nodes[t].parent == -1 ? 0 : 1));

    // Neighbours are in one node, or one's node is an ancestor of the other's: nothing crosses a separator.
    std::vector<Index> const node_of = cut.node_of_position();
    for (std::int32_t a = 0; a < n; ++a)
        for (std::int32_t const b : graph.near[static_cast<std::size_t>(a)]) {
            Index const first = std::min(position[static_cast<std::size_t>(a)], position[static_cast<std::size_t>(b)]);
            Index const above = node_of[static_cast<std::size_t>(
                std::max(position[static_cast<std::size_t>(a)], position[static_cast<std::size_t>(b)]))];
            Index up = node_of[static_cast<std::size_t>(first)];
            while (up != -1 && up < above) up = cut.tree.nodes[up].parent;
            CHECK(up == above);
        }
}

}  // namespace

TEST_CASE("nasty graphs: lines, stars, cliques, everything in one place, nothing joined") {
    for (HandMadeGraph& graph : nasty_graphs()) check_dissection(graph);
}

TEST_CASE("graphs of meshes") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case its = two_body_case(kind, 20, 14);
        Analysed const seen(its);
        harmorph::Graph const& graph = seen->graph;
        HandMadeGraph copy;
        for (Index u = 0; u < graph.n; ++u) {
            Point const p = its.mesh.point(graph.point(u));
            copy.add_point(p.x, p.y);
        }
        for (Index u = 0; u < graph.n; ++u)
            for (Index const v : graph.of(u)) copy.join(u, v);
        check_dissection(copy);
    }
}

TEST_CASE("on grids the separators are short, so that fill grows as n log n") {
    double per_point[3];
    int const sizes[] = {32, 64, 128};
    for (int s = 0; s < 3; ++s) {
        HandMadeGraph graph = grid_graph(sizes[s], sizes[s]);
        Dissected const cut(graph);
        auto const& root = cut.tree.nodes[cut.tree.count - 1];
        CHECK(root.pivots() <= 3 * sizes[s] / 2);
        // Count the factor as the symbolic pass does: by each subtree's border.
        std::vector<Index> const position = cut.position(), node_of = cut.node_of_position();
        std::vector<std::set<Index>> border(static_cast<std::size_t>(cut.tree.count));
        double entries = 0;
        for (Index t = 0; t < cut.tree.count; ++t) {
            auto const& node = cut.tree.nodes[t];
            std::set<Index>& own = border[static_cast<std::size_t>(t)];
            for (Index k = node.begin; k < node.end; ++k)
                for (std::int32_t const v : graph.near[static_cast<std::size_t>(cut.order[static_cast<std::size_t>(k)])])
                    own.insert(position[static_cast<std::size_t>(v)]);
            for (Index child = node.child; child != -1; child = cut.tree.nodes[child].sibling)
                own.insert(border[static_cast<std::size_t>(child)].begin(), border[static_cast<std::size_t>(child)].end());
            own.erase(own.begin(), own.lower_bound(node.end));
            entries += 0.5 * node.pivots() * node.pivots() + 1.0 * node.pivots() * static_cast<double>(own.size());
        }
        per_point[s] = entries / graph.n();
    }
    INFO("entries per unknown: " << per_point[0] << " " << per_point[1] << " " << per_point[2]);
    CHECK(per_point[2] < 80);
    CHECK(per_point[1] - per_point[0] < 16);   // linear in log n; doubling if it grew as n
    CHECK(per_point[2] - per_point[1] < 16);
}

TEST_CASE("a rolled strip is cut across, however its turns lie beside each other") {
    int const along = 90, across = 6;
    HandMadeGraph strip = grid_graph(along, across);
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < along; ++i) {
            double const turn = 0.3 * i, radius = 1 + 0.01 * turn + 0.001 * j;   // straight cuts cross all turns
            strip.x[static_cast<std::size_t>(i + along * j)] = radius * std::cos(turn);
            strip.y[static_cast<std::size_t>(i + along * j)] = radius * std::sin(turn);
        }
    for (int i = 0; i < along; ++i) strip.beside_curve.insert(i);                // and layers run along
    Dissected const cut(strip);
    auto const& root = cut.tree.nodes[cut.tree.count - 1];
    CHECK(root.pivots() <= across);
    check_dissection(strip);
}

TEST_CASE("any number of threads, in any order of their tasks: the same order and the same tree") {
    std::vector<HandMadeGraph> graphs = nasty_graphs();
    graphs.push_back(grid_graph(50, 40));
    graphs.push_back(grid_graph(3, 2));
    for (HandMadeGraph& graph : graphs) {
        Dissected const alone(graph);
        for (Index const threads : {1, 2, 3, 200}) {
            Backwards order;
            Dissected const together(graph, {Backwards::run, &order, threads});
            CHECK(together.order == alone.order);
            REQUIRE(together.tree.count == alone.tree.count);
            CHECK(std::memcmp(together.tree.nodes.data(), alone.tree.nodes.data(),
                              sizeof(harmorph::AssemblyTree::Node) * static_cast<std::size_t>(alone.tree.count)) == 0);
            CHECK((order.tasks > 0) == (threads > 1));
        }
    }
}
