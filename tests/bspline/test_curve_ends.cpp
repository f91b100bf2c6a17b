#include <doctest/doctest.h>

#include <harmorph/bspline/curve_ends.hpp>

#include <fixtures/spline.hpp>

#include <algorithm>

using namespace harmorph;

namespace {

struct Chosen {
    Course course;
    std::vector<Index> corners;  // positions
};

Chosen choose(std::vector<Vec2> const& points, Closure wanted, bool is_loop = true, Index most = 100) {
    auto const n = static_cast<Index>(points.size());
    Arena counting;
    Outline().lay_out(counting, n);
    std::vector<unsigned char> block(counting.bytes());
    Arena placing(block.data(), block.size());
    Outline outline;
    outline.lay_out(placing, n);
    outline.points = {points.data(), points.size()};
    outline.is_loop = is_loop;
    outline.measure();
    Chosen out;
    out.corners.resize(points.size());
    Span<Index> const corners{out.corners.data(), out.corners.size()};
    Index const n_corners = find_corners(outline, corners);
    out.course = choose_course(outline, corners.first(n_corners), wanted);
    out.corners.resize(static_cast<std::size_t>(corners_on(out.course, outline, corners.first(n_corners), most)));
    return out;
}

std::vector<Vec2> turned_by(std::vector<Vec2> points, int places) {
    std::rotate(points.begin(), points.begin() + places, points.end());
    return points;
}

}  // namespace

TEST_CASE("no corner: periodic; one: tied at it; a blunt base: open, the long way round") {
    Chosen const round = choose(fixtures::ellipse(60, 0.2), Closure::automatic);
    CHECK(round.course.closure == Closure::periodic);
    CHECK(round.course.n_positions == 61);
    CHECK(round.course.first % 30 == 0);  // at one of the tips
    for (int const places : {0, 7, 50}) {
        auto const sharp = choose(turned_by(fixtures::vectors(fixtures::naca4({}, 30)), places), Closure::automatic);
        CHECK(sharp.course.closure == Closure::tied);
        CHECK(sharp.course.first == (60 - places) % 60);
        CHECK(sharp.corners.empty());
        auto const blunt = choose(turned_by(fixtures::vectors(fixtures::naca4({0, 0.4, 0.12, true}, 30, 0.8, 4)), places),
                                  Closure::automatic);  // 64 points, 5 of them on the base
        CHECK(blunt.course.closure == Closure::open);
        CHECK(blunt.course.first == (68 - places) % 64);
        CHECK(blunt.course.base_points == 5);
        CHECK(blunt.course.n_positions == 61);
        CHECK(blunt.corners.empty());
    }
}

TEST_CASE("other corners lie on the course, the sharpest ones if there is not room for all") {
    std::vector<Vec2> const kite = fixtures::polygon({{0.6, 0}, {0, 0.1}, {-0.4, 0}, {0, -0.1}}, 10);
    Chosen const all = choose(turned_by(kite, 5), Closure::automatic);
    CHECK(all.course.closure == Closure::tied);
    CHECK(all.course.first == 35);
    CHECK(all.corners == std::vector<Index>{10, 20, 30});
    CHECK(choose(kite, Closure::automatic, true, 1).corners == std::vector<Index>{20});
    CHECK(choose(kite, Closure::automatic, true, 0).corners.empty());
}

TEST_CASE("the caller's wish is followed") {
    std::vector<Vec2> const blunt = fixtures::vectors(fixtures::naca4({0, 0.4, 0.12, true}, 30, 0.8, 4));
    Chosen const tied = choose(blunt, Closure::tied);
    CHECK(tied.course.closure == Closure::tied);
    CHECK(tied.course.first == 0);
    CHECK(tied.corners == std::vector<Index>{4});
    Chosen const smooth = choose(blunt, Closure::periodic);
    CHECK(smooth.course.closure == Closure::periodic);
    CHECK(smooth.corners.empty());
    Chosen const open = choose(blunt, Closure::open);
    CHECK(open.course.closure == Closure::open);
    CHECK(open.course.first == 0);
    CHECK(open.course.n_positions == 64);
    CHECK(open.corners == std::vector<Index>{4});
    Chosen const edge = choose(fixtures::rounded_edge(100, 2e-3, 8), Closure::tied);
    CHECK(edge.course.first == 204);  // the middle of the rounded edge: the edge has points 200 to 207, and 0
    CHECK(choose({{0, 0}, {1, 0}, {2, 1}}, Closure::automatic, false).course.closure == Closure::open);
}
