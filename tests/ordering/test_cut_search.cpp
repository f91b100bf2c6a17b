// Parts are cut in the middle, across the shorter direction, behind the cheapest level, with
// borders taken into account.
#include <fixtures/graphs.hpp>
#include <fixtures/guarded.hpp>

#include "ordering/bisection.hpp"

using namespace fixtures;
using harmorph::Cut;
using harmorph::CutSizes;
using harmorph::Index;

namespace {

struct Searched {
    explicit Searched(HandMadeGraph& graph) : order(graph.x.size()) {
        block_ = laid_out([&](harmorph::Arena& arena) {
            places.lay_out(arena, graph.n());
            places.lay_out_layers(arena, graph.n());
        });
        find_coordinates(places, graph.view(), graph.points());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = Index(k);
        search = std::make_unique<harmorph::CutSearch>(graph.view(), places, span(order));
    }
    ~Searched() { CHECK(block_->guards_intact()); }
    Index n() const { return Index(order.size()); }
    Index left_of(Cut const& cut) const {
        Index left = 0;
        for (Index u = 0; u < n(); ++u) left += places.position[u].at[cut.direction] < cut.level;
        return left;
    }

    harmorph::CutCoordinates places;
    std::vector<Index> order;
    std::unique_ptr<harmorph::CutSearch> search;

private:
    std::unique_ptr<Guarded> block_;
};

// Multiplications of a part of n unknowns with a border of b: its separator of n^1/2 pivots, then
// both halves in the same way, each with half the border and the separator.
double cost_by_halving(double n, double b) {
    if (n < 1e-6) return 0;  // far below one unknown, so that nothing is cut off
    double const s = std::sqrt(n);
    return s * (s * s / 3 + s * b + b * b) + 2 * cost_by_halving(n / 2, b / 2 + s);
}

}  // namespace

TEST_CASE("grids are cut across the shorter direction near the middle, also in samples") {
    for (int const times : {1, 9}) {  // a small part and a large one
        int const length = 60 * times, width = 37 * times;
        for (bool const upright : {false, true}) {
            HandMadeGraph grid = upright ? grid_graph(width, length) : grid_graph(length, width);
            Searched search(grid);
            CHECK((search.n() >= CutSizes::large) == (times > 1));
            Cut const cut = search.search->best(0, search.n(), harmorph::straight_directions);
            CHECK(cut.direction == (upright ? 1 : 0));
            CHECK(std::abs(search.left_of(cut) - search.n() / 2) < search.n() / 8);
        }
    }
}

TEST_CASE("a square with a border along one side is cut so that both halves share the border") {
    int const side = 300;
    REQUIRE(side * side >= CutSizes::large);
    for (Index const direction : {0, 1}) {
        HandMadeGraph grid = grid_graph(side, side);
        Searched search(grid);
        for (Index u = 0; u < search.n(); ++u) {
            int const at = direction == 0 ? u / side : u % side;
            if (at == 0) search.places.position[u].at[harmorph::border_lane] = 1;
        }
        CHECK(search.search->border(0, search.n(), search.n()) == side);
        CHECK(search.search->border(0, search.n(), CutSizes::large - 1) == 0);
        CHECK(search.search->best(0, search.n(), harmorph::straight_directions).direction ==
              direction);
    }
}

TEST_CASE("the cost grows with separator, borders and remaining parts, and is symmetric") {
    for (Index const half : {40, 200000}) {
        auto const cost = [&](Index shift, Index separator, Index left_border = 0,
                              Index right_border = 0) {
            return CutSizes{half + shift, half - shift, separator, left_border, right_border}
                .cost();
        };
        CHECK(cost(0, 8) < cost(0, 9));
        CHECK(cost(0, 8) < cost(half / 4, 8));
        CHECK(cost(half / 4, 8, 5, 3) == doctest::Approx(cost(-half / 4, 8, 3, 5)).epsilon(1e-14));
        if (half < CutSizes::large) continue;
        CHECK(cost(0, 800, 100, 100) < cost(0, 800, 200, 200));
        CHECK(cost(0, 800, 200, 200) < cost(0, 800, 0, 400));
    }
}

TEST_CASE("the cost of large parts is that of repeated bisection, but for rounded constants") {
    for (Index const separator : {300, 450, 900})
        for (Index const left_border : {0, 400, 1600})
            for (Index const right_border : {0, 700}) {
                Index const left = 120000, right = 90000;
                double const s = separator, b = left_border + right_border;
                double const expected = s * (s * s / 3 + s * b + b * b) +
                                        cost_by_halving(left, left_border + s) +
                                        cost_by_halving(right, right_border + s);
                CHECK(CutSizes{left, right, separator, left_border, right_border}.cost() ==
                      doctest::Approx(expected).epsilon(0.0125));  // 30 instead of 30.37
            }
}

TEST_CASE("the cut is behind the cheapest level in the middle half, if that beats the known cost") {
    HandMadeGraph grid = grid_graph(41, 9);
    Searched search(grid);
    Cut cut;
    CHECK(!search.search->find_level_cut(0, 0, search.n(), cut));
    CHECK(cut.direction == harmorph::none);
    REQUIRE(search.search->find_level_cut(harmorph::infinity, 0, search.n(), cut));
    CHECK(cut.direction == harmorph::level_direction);
    std::map<float, Index> size;
    for (Index u = 0; u < search.n(); ++u)
        ++size[search.places.position[u].at[harmorph::level_direction]];
    double least = harmorph::infinity;
    float best = 0;
    Index before = 0;
    for (auto const& [level, count] : size) {
        Index const behind = search.n() - before - count;
        double const cost = CutSizes{before, behind, count}.cost();
        if (before >= search.n() / 4 && behind >= search.n() / 4 && cost < least) {
            least = cost;
            best = level;
        }
        before += count;
    }
    CHECK(cut.level == best + 0.5f);
    CHECK(!search.search->find_level_cut(least, 0, search.n(), cut));
}
