// Ranges of positions that are independent, and what lies between them.
#include <fixtures/graphs.hpp>

using namespace fixtures;
using harmorph::Index;
using harmorph::PositionRange;
using harmorph::SubtreeRanges;

TEST_CASE("subtrees are small enough and not too many, and neighbours are never in two of them") {
    HandMadeGraph graph = grid_graph(60, 50);
    Dissected const cut(graph);
    std::vector<Index> const position = cut.position();
    for (Index const largest : {25, 200, 1000, 2999, 3000}) {
        for (Index const limit : {1, 7, 64}) {
            SubtreeRanges ranges;
            ranges.choose(cut.tree, largest, limit);
            REQUIRE(ranges.count <= limit);
            std::vector<Index> owner(3000, -1);
            for (Index i = 0; i < ranges.count; ++i) {
                PositionRange const range = ranges.subtree[i];
                CHECK(range.end - range.begin <= largest);
                for (Index k = range.begin; k < range.end; ++k) owner[std::size_t(k)] = i;
            }
            int across = 0;
            for (std::int32_t u = 0; u < graph.n(); ++u)
                for (std::int32_t const v : graph.near[std::size_t(u)]) {
                    Index const of_u = owner[std::size_t(position[std::size_t(u)])];
                    Index const of_v = owner[std::size_t(position[std::size_t(v)])];
                    across += of_u >= 0 && of_v >= 0 && of_u != of_v;
                }
            CHECK(across == 0);
            // The ranges between them complete them to all positions.
            std::vector<Index> left;
            for (Index k = 0; k < graph.n(); ++k)
                if (owner[std::size_t(k)] < 0) left.push_back(k);
            std::vector<Index> between;
            ranges.for_each_between(graph.n(), [&](PositionRange range) {
                CHECK(range.begin < range.end);
                for (Index k = range.begin; k < range.end; ++k) between.push_back(k);
            });
            CHECK(between == left);
        }
    }
    SubtreeRanges whole;
    whole.choose(cut.tree, 3000);
    CHECK(whole.count == 1);
    whole.choose(harmorph::AssemblyTree{}, 3000);
    CHECK(whole.count == 0);
}
