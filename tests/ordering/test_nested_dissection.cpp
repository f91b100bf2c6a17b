// The order of elimination is a permutation, its tree a postorder, and separators separate.
#include <fixtures/executors.hpp>
#include <fixtures/graphs.hpp>
#include <fixtures/wrong.hpp>

#include "ordering/bisection.hpp"

using namespace fixtures;
using harmorph::Index;

namespace {

void check_dissection(HandMadeGraph& graph) {
    Dissected const cut(graph);
    std::int32_t const n = graph.n();
    INFO(n << " unknowns");

    std::vector<Index> const position = cut.position();
    for (Index const p : position) CHECK(p >= 0);  // each unknown once, as there are as many places

    // Nodes tile the order; children come before their parents and fill the places just before
    // them.
    CHECK(cut.tree.count <= n / 2 + 1);
    Index next = 0, roots = 0;
    std::vector<Index> subtree_begin(std::size_t(cut.tree.count));
    std::vector<int> times_child(std::size_t(cut.tree.count), 0);
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
            begin = std::min(begin, subtree_begin[std::size_t(child)]);
            ++times_child[std::size_t(child)];
        }
        subtree_begin[std::size_t(t)] = begin;
    }
    CHECK(next == n);
    CHECK(roots == 1);
    for (Index t = 0; t < cut.tree.count; ++t)
        CHECK(times_child[std::size_t(t)] == (cut.tree.nodes[t].parent == -1 ? 0 : 1));

    // Neighbours are in one node, or one's node is an ancestor of the other's: nothing crosses a
    // separator.
    std::vector<Index> const node_of = cut.node_of_position();
    for (std::int32_t a = 0; a < n; ++a)
        for (std::int32_t const b : graph.near[std::size_t(a)]) {
            Index const first = std::min(position[std::size_t(a)], position[std::size_t(b)]);
            Index const above =
                node_of[std::size_t(std::max(position[std::size_t(a)], position[std::size_t(b)]))];
            Index up = node_of[std::size_t(first)];
            while (up != -1 && up < above) up = cut.tree.nodes[up].parent;
            CHECK(up == above);
        }
}

// Entries per unknown of a square grid of n unknowns, whose cells couple their diagonals: the
// leading term of what A. George, SIAM J. Numer. Anal. 10 (1973) 345, counts for nested dissection.
double george(double n) { return 31.0 / 4 * std::log2(std::sqrt(n)); }

}  // namespace

TEST_CASE("lines, stars, cliques, coincident points and graphs without edges are ordered") {
    for (HandMadeGraph& graph : nasty_graphs()) check_dissection(graph);
}

TEST_CASE("graphs of meshes are ordered") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = two_body_case(kind, 20, 14);
        Analysed const seen(setup);
        harmorph::Graph const& graph = seen->graph();
        HandMadeGraph copy;
        for (Index u = 0; u < graph.n; ++u) {
            Point const p = setup.mesh.point(graph.point(u));
            copy.add_point(p.x, p.y);
        }
        for (Index u = 0; u < graph.n; ++u)
            for (Index const v : graph.neighbours(u)) copy.join(u, v);
        check_dissection(copy);
    }
}

TEST_CASE("separators of grids are short, so that fill grows as n log n") {
    double per_point[3];
    int const sizes[] = {32, 64, 128};
    for (int s = 0; s < 3; ++s) {
        HandMadeGraph graph = grid_graph(sizes[s], sizes[s]);
        Dissected const cut(graph);
        auto const& root = cut.tree.nodes[cut.tree.count - 1];
        CHECK(root.pivots() <= 3 * sizes[s] / 2);
        per_point[s] = FactorCost(graph, cut).entries / graph.n();
    }
    INFO("entries per unknown: " << per_point[0] << " " << per_point[1] << " " << per_point[2]);
    for (int s = 0; s < 3; ++s) CHECK(per_point[s] < george(sizes[s] * sizes[s]));
    CHECK(per_point[1] - per_point[0] < 16);  // linear in log n; doubling if it grew as n
    CHECK(per_point[2] - per_point[1] < 16);
}

TEST_CASE("a rolled strip is cut across, wherever its turns lie beside each other") {
    int const along = 90, across = 6;
    HandMadeGraph strip = grid_graph(along, across);
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < along; ++i) {
            double const turn = 0.3 * i,
                         radius = 1 + 0.01 * turn + 0.001 * j;  // straight cuts cross all turns
            strip.x[std::size_t(i + along * j)] = radius * std::cos(turn);
            strip.y[std::size_t(i + along * j)] = radius * std::sin(turn);
        }
    for (int i = 0; i < along; ++i) strip.beside_curve.insert(i);  // and layers run along
    Dissected const cut(strip);
    auto const& root = cut.tree.nodes[cut.tree.count - 1];
    CHECK(root.pivots() <= across);
    check_dissection(strip);
}

TEST_CASE("a wake of thin curved cells has few more entries than when laid out straight") {
    // Fill is a property of the graph; coordinates only say where to cut. Levels are tried as soon
    // as a separator is 1.12 times as long as one through a square, and entries go with the square
    // of this length.
    double const most = 1.12 * 1.12;
    for (int const nx : {60, 120}) {
        int const ny = 60;
        HandMadeGraph grid = grid_graph(nx, ny);
        for (int j = 0; j < ny; ++j)
            grid.beside_curve.insert(nx * j);  // the body; layers round it cross the wake
        double const straight = FactorCost(grid, Dissected(grid)).entries;
        for (double const thin :
             {1e-3, 1e-4}) {  // height of the cells in the middle, about, beside their length
            for (int k = 0; k < grid.n(); ++k) {
                double const x = 1.0 * (k % nx) / ny, across = 1.0 * (k / nx) / ny - 0.5;
                grid.x[std::size_t(k)] = x;
                double const shear_layer = thin * std::sinh(-2 * std::log(thin) * across);
                grid.y[std::size_t(k)] = 0.2 * std::sin(3 * x) + shear_layer;
            }
            double const curved = FactorCost(grid, Dissected(grid)).entries;
            INFO(nx << " x " << ny << ", thin " << thin << ": " << curved << " entries instead of "
                    << straight);
            CHECK(curved < most * straight);
        }
    }
}

TEST_CASE("large parts know the unknowns next to the separators above them, and mark no others") {
    for (int const ny : {250, 270}) {  // small and large, as a whole
        HandMadeGraph grid = grid_graph(250, ny);
        bool const is_large = grid.n() >= harmorph::CutSizes::large;
        CHECK(is_large == (ny == 270));
        Wrong wrong;
        Index marked = 0;
        Dissected(grid, [&](auto const& work, auto order, auto&) {
            harmorph::Graph const& graph = grid.view();
            find_coordinates(work.coordinates, graph, grid.points());
            fill(work.cover.side.first(graph.n), harmorph::Side::inside);
            for (Index u = 0; u < graph.n; ++u) order[u] = u;
            harmorph::DividedRange const range =
                harmorph::Dissector(graph, work, order).divide(0, graph.n);
            REQUIRE(range.pivots < graph.n);
            std::vector<char> is_next(grid.x.size(), 0);
            for (Index k = range.pivots; k < graph.n; ++k)
                for (Index const v : graph.neighbours(order[k])) is_next[std::size_t(v)] = 1;
            for (Index k = 0; k < range.pivots; ++k) {
                float const mark = work.coordinates.position[order[k]].at[harmorph::border_lane];
                marked += mark == 1;
                wrong.compare(order[k], mark, is_large ? is_next[std::size_t(order[k])] : 0);
            }
        });
        CHECK(wrong == 0);
        CHECK(marked ==
              (is_large ? 2 * 250 : 0));  // a row on either side of the shortest separator
    }
}

TEST_CASE("marks of separators above large parts save multiplications") {
    // Halves of 260 x 270 unknowns, the first separator along their shorter side. The shortest cut
    // of a half is parallel to it: a quarter of the mesh then lies between two separators of 260.
    // One across costs 270, but both quarters share what borders on the first one.
    HandMadeGraph grid = grid_graph(260, 541);
    double cost[2];
    for (bool const is_marked : {false, true}) {
        Dissected const cut(grid, [&](auto const& work, auto order, auto& tree) {
            harmorph::Graph const& graph = grid.view();
            find_coordinates(work.coordinates, graph, grid.points());
            fill(work.cover.side.first(graph.n), harmorph::Side::inside);
            harmorph::Dissector const dissector(graph, work, order);
            for (Index u = 0; u < graph.n; ++u) order[u] = u;
            harmorph::DividedRange const range = dissector.divide(0, graph.n);
            REQUIRE(range.middle >= harmorph::CutSizes::large);
            REQUIRE(range.pivots - range.middle >= harmorph::CutSizes::large);
            for (Index u = 0; u < graph.n && !is_marked; ++u)
                work.coordinates.position[u].at[harmorph::border_lane] = 0;
            tree.count = 0;
            Index const first = dissector.dissect(0, range.middle, tree);
            Index const second = dissector.dissect(range.middle, range.pivots, tree);
            tree.add(range.pivots, graph.n, first, second);
        });
        FactorCost const factor_cost(grid, cut);
        cost[is_marked] = factor_cost.multiplications;
        CHECK(factor_cost.entries <
              george(grid.n()) * grid.n());  // a rectangle of two squares has less than a square
    }
    INFO(cost[true] << " multiplications with marks, " << cost[false] << " without");
    CHECK(cost[true] < cost[false]);
}

TEST_CASE("any number of threads in any order of tasks gives the same order and tree") {
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
            CHECK(std::memcmp(
                      together.tree.nodes.data(), alone.tree.nodes.data(),
                      sizeof(harmorph::AssemblyTree::Node) * std::size_t(alone.tree.count)) == 0);
            CHECK((order.tasks > 0) == (threads > 1));
        }
    }
}
