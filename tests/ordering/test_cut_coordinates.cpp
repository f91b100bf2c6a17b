// Places and reaches of unknowns: no neighbour is farther away than it is said to be. Levels of
// parts.
#include <fixtures/graphs.hpp>
#include <fixtures/wrong.hpp>
#include <fixtures/guarded.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

struct PlacedGraph {
    explicit PlacedGraph(HandMadeGraph& graph) {
        block_ = laid_out([&](harmorph::Arena& arena) {
            places.lay_out(arena, graph.n());
            places.lay_out_layers(arena, graph.n());
        });
        find_coordinates(places, graph.view(), graph.points());
    }
    ~PlacedGraph() { CHECK(block_->guards_intact()); }

    harmorph::CutCoordinates places;

private:
    std::unique_ptr<Guarded> block_;
};

}  // namespace

TEST_CASE("neighbours lie within reach in every direction, and layers grow by one") {
    for (HandMadeGraph& graph : nasty_graphs()) {
        PlacedGraph placed(graph);
        harmorph::CutCoordinates const& places = placed.places;
        Wrong outside, jumps;
        for (Index u = 0; u < graph.n(); ++u)
            for (Index const v : graph.near[std::size_t(u)]) {
                for (Index d = 0; d < harmorph::directions; ++d) {
                    float const step = places.position[v].at[d] - places.position[u].at[d];
                    outside.add(std::fabs(step) > places.position[u].reach[d], u, step);
                }
                float const from = places.position[u].at[harmorph::layer_direction];
                float const to = places.position[v].at[harmorph::layer_direction];
                jumps.add(std::fabs(to - from) > 1, u, to - from);
            }
        CHECK(outside == 0);
        CHECK(jumps == 0);
        for (Index u = 0; u < graph.n(); ++u)
            if (graph.view().beside_curve[u] != 0)
                CHECK(places.position[u].at[harmorph::layer_direction] == 0);
    }
}

TEST_CASE("steps across a piece are 1 on the piece, signed beside it, and complete") {
    int const around = 24, rings = 5;
    HandMadeGraph ring = grid_graph(around, rings);
    for (int j = 0; j < rings; ++j) ring.join(around * j, around * j + around - 1);
    PlacedGraph placed(ring);
    // The piece is column 0; the columns behind it are those of the second half.
    placed.places.find_across(
        ring.view(), 0, [&](Index u) { return u % around == 0; },
        [&](Index u) { return u % around < around / 2; });
    placed.places.keep_searches(ring.view(), {});
    auto const step = [&](Index u) {
        return placed.places.position[u].at[harmorph::across_direction];
    };
    for (Index u = 0; u < ring.n(); ++u) {
        int const column = u % around, back = around - column;
        CHECK(step(u) == (column == 0 ? 1 : column <= back ? column + 1 : -back));
        float farthest = 1;
        for (Index const v : ring.near[std::size_t(u)])
            farthest = std::fmax(farthest, std::fabs(step(v) - step(u)));
        CHECK(placed.places.position[u].reach[harmorph::across_direction] == farthest);
    }
}

TEST_CASE("levels are steps from an end of the part, at most one between neighbours; complete") {
    std::vector<HandMadeGraph> graphs = nasty_graphs();
    graphs.push_back(grid_graph(7, 3));
    for (HandMadeGraph& graph : graphs) {
        PlacedGraph placed(graph);
        auto const level = [&](Index u) {
            return placed.places.position[u].at[harmorph::level_direction];
        };
        std::vector<Index> all(std::size_t(graph.n()));
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = Index(k);
        placed.places.find_levels(graph.view(), span(all), placed.places.queue);
        std::set<Index> seen;
        Wrong jumps, falls;
        for (Index k = 0; k < graph.n(); ++k) {
            Index const u = placed.places.queue[k];
            seen.insert(u);
            if (k > 0) falls.add(level(u) < level(placed.places.queue[k - 1]), u, level(u));
            for (Index const v : graph.near[std::size_t(u)])
                jumps.add(std::fabs(level(v) - level(u)) > 1, u, level(v) - level(u));
        }
        CHECK(seen.size() == all.size());
        CHECK(level(placed.places.queue[0]) == 0);
        CHECK(falls == 0);
        CHECK(jumps == 0);
    }
    HandMadeGraph grid =
        grid_graph(9, 3);  // the second half is a part: its own end is where its levels begin
    PlacedGraph placed(grid);
    std::vector<Index> half;
    for (Index u = 0; u < 27; ++u) {
        if (u % 9 > 4) half.push_back(u);
    }
    placed.places.find_levels(grid.view(), span(half), placed.places.queue);
    Index const first = placed.places.queue[0];
    for (Index const u : half) {
        float const expected = float(std::abs(u % 9 - first % 9));
        CHECK((first % 9 == 5 || first % 9 == 8));
        CHECK(placed.places.position[u].at[harmorph::level_direction] >= expected);
        CHECK(placed.places.position[u].at[harmorph::level_direction] <= 3);
    }
}
