// Places and reaches of unknowns: no neighbour is farther away than it is said to be.
#include <doctest/doctest.h>

#include <fixtures/graphs.hpp>

using namespace fixtures;
using harmorph::Index;

TEST_CASE("neighbours lie within reach in every direction; layers grow by one") {
    for (HandMadeGraph& graph : nasty_graphs()) {
        harmorph::Arena counting;
        harmorph::Places places;
        places.lay_out(counting, graph.n());
        Guarded block(counting.bytes());
        harmorph::Arena placing(block.data(), block.size());
        places.lay_out(placing, graph.n());
        places.find(graph.view(), graph.points(), {});
        CHECK(block.guards_intact());
        int outside = 0, jumps = 0;
        for (Index u = 0; u < graph.n(); ++u)
            for (Index const v : graph.near[static_cast<std::size_t>(u)]) {
                for (Index d = 0; d < harmorph::directions; ++d) {
                    float const step = places.place[v].at[d] - places.place[u].at[d];
                    outside += step > places.reach[u].ahead[d] || -step > places.reach[u].behind[d];
                }
                float const from = places.place[u].at[harmorph::layer_direction];
                float const to = places.place[v].at[harmorph::layer_direction];
                jumps += std::fabs(to - from) > 1;
            }
        CHECK(outside == 0);
        CHECK(jumps == 0);
        for (Index u = 0; u < graph.n(); ++u)
            if (graph.view().beside_curve[u] != 0) CHECK(places.place[u].at[harmorph::layer_direction] == 1);
    }
}
