// Covers of cut edges: they cover, they are as small as the largest matching, and nothing else
// changes sides.
#include <fixtures/graphs.hpp>
#include <fixtures/wrong.hpp>
#include <fixtures/guarded.hpp>

using fixtures::grid_graph;
using fixtures::Guarded;
using fixtures::HandMadeGraph;
using fixtures::nasty_graphs;
using fixtures::span;
using fixtures::Wrong;
using harmorph::Index;
using harmorph::Side;

namespace {

struct Covered {
    std::vector<Side> before, after;
    std::vector<Index> near;

    // is_left(unknown) for all; what is far from the cut stays inside, as in a dissection.
    template <class IsLeft>
    Covered(HandMadeGraph& graph, IsLeft is_left) {
        std::size_t const n = std::size_t(graph.n());
        harmorph::BorderCover cover;
        auto const block = fixtures::laid_out_part(cover, graph.n());
        for (Index u = 0; u < graph.n(); ++u) {
            bool is_near = false;
            for (Index const v : graph.near[std::size_t(u)])
                is_near = is_near || is_left(u) != is_left(v);
            cover.side[u] = !is_near ? Side::inside : is_left(u) ? Side::left : Side::right;
            if (is_near) near.push_back(u);
        }
        before.assign(cover.side.begin(), cover.side.end());
        std::vector<Index> queue(n);
        cover.find(graph.view(), span(near), span(queue));
        after.assign(cover.side.begin(), cover.side.end());
        CHECK(block->guards_intact());
    }
    int count(Side side, std::vector<Side> const& sides) const {
        return int(std::count(sides.begin(), sides.end(), side));
    }
};

// The size of a largest matching of the cut edges, by augmenting paths.
class Matching {
public:
    Matching(HandMadeGraph const& graph, Covered const& cut)
        : graph_(graph), cut_(cut), mate_(graph.x.size(), -1) {}
    int size() {
        int pairs = 0;
        for (Index const u : cut_.near) {
            seen_.clear();
            pairs += cut_.before[std::size_t(u)] == Side::left && augment(u);
        }
        return pairs;
    }

private:
    bool augment(Index u) {
        for (Index const v : graph_.near[std::size_t(u)]) {
            if (cut_.before[std::size_t(v)] != Side::right || !seen_.insert(v).second) continue;
            Index& mate = mate_[std::size_t(v)];
            if (mate != -1 && !augment(mate)) continue;
            mate = u;
            return true;
        }
        return false;
    }
    HandMadeGraph const& graph_;
    Covered const& cut_;
    std::vector<Index> mate_;
    std::set<Index> seen_;
};

template <class IsLeft>
void check_cover(HandMadeGraph& graph, IsLeft is_left) {
    Covered const cut(graph, is_left);
    Wrong crossing, changed;
    for (Index u = 0; u < graph.n(); ++u) {
        std::size_t const k = std::size_t(u);
        Side const side = cut.after[k];
        changed.add(side != Side::separator && side != cut.before[k], u, double(side));
        for (Index const v : graph.near[k])
            crossing.add(side == Side::left && cut.after[std::size_t(v)] == Side::right, u, v);
    }
    CHECK(crossing == 0);
    CHECK(changed == 0);
    CHECK(cut.count(Side::separator, cut.after) == Matching(graph, cut).size());
}

}  // namespace

TEST_CASE("the cover is smallest for straight, slanting and ragged cuts and other graphs") {
    for (bool const diagonals : {true, false}) {
        HandMadeGraph grid = grid_graph(13, 11, diagonals);
        check_cover(grid, [](Index u) { return u % 13 < 6; });
        check_cover(grid, [](Index u) { return u % 13 < u / 13; });
        check_cover(grid, [](Index u) { return 2 * (u % 13) < 3 * (u / 13); });
        check_cover(grid, [](Index u) { return (u * 7919) % 101 < 50; });
    }
    for (HandMadeGraph& graph : nasty_graphs())
        check_cover(graph, [&](Index u) { return 2 * u < graph.n(); });
}

TEST_CASE("the left hub of a star covers its edges alone, and so does the right one") {
    for (bool const hub_is_left : {true, false}) {
        HandMadeGraph star;
        for (int k = 0; k < 40; ++k) star.add_point(k, 0);
        for (int k = 1; k < 40; ++k) star.join(0, k);
        Covered const cut(star, [&](Index u) { return (u == 0) == hub_is_left; });
        CHECK(cut.count(Side::separator, cut.after) == 1);
        CHECK(cut.after[0] == Side::separator);
    }
}
