#include <doctest/doctest.h>

#include "bspline/curve_ends.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

#include <algorithm>

using namespace harmorph;
using fixtures::naca;
using fixtures::pi;

namespace {

struct Measured {
    std::vector<Vec2> points;
    std::unique_ptr<fixtures::Guarded> block;
    Outline outline;
    std::vector<Index> corners;

    explicit Measured(std::vector<Vec2> const& given, bool is_loop = true)
        : points(given), corners(given.size()) {
        auto const n = Index(points.size());
        block = fixtures::laid_out_part(outline, n);
        outline.points = {points.data(), points.size()};
        outline.is_loop = is_loop;
        outline.measure();
        corners.resize(std::size_t(find_corners(outline, {corners.data(), corners.size()})));
    }
};

using Indices = std::vector<Index>;

Indices corners_of(std::vector<Vec2> const& points, bool is_loop = true) {
    return Measured(points, is_loop).corners;
}

}  // namespace

TEST_CASE("arc lengths, turns and curvature of a circle are right") {
    for (int const n : {12, 100, 5000}) {
        Measured const circle(fixtures::ellipse(n, 1));
        CHECK(circle.outline.arc[n] == doctest::Approx(n * std::sin(pi / n)).epsilon(1e-12));
        for (int k = 0; k < n; ++k)
            CHECK(circle.outline.curvature[k] == doctest::Approx(2).epsilon(1e-3));
        CHECK(circle.corners.empty());
    }
}

TEST_CASE("a given length along the outline leads to the right place") {
    Measured const square(fixtures::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}, 10));
    CHECK(square.outline.ahead(0, 0.12) == 3);
    CHECK(square.outline.ahead(38, 0.12) == 1);
    CHECK(square.outline.behind(3, 0.12) == 0);
    CHECK(square.outline.behind(1, 0.12) == 38);
    CHECK(square.outline.ahead(39, 1e-6) == 0);
    CHECK(square.outline.behind(0, 1e-6) == 39);
    Measured const line({{0, 0}, {1, 0}, {2, 0}}, false);
    CHECK(line.outline.ahead(2, 0.1) == none);
    CHECK(line.outline.ahead(1, 1.5) == none);
    CHECK(line.outline.behind(0, 0.1) == none);
    CHECK(line.outline.turning[1] == 0);
}

TEST_CASE("sharp trailing edges are corners, and rounded leading edges are not") {
    for (int const n : {15, 20, 50, 100, 1000, 2500})
        for (double const clustering : {0.3, 0.8, 1.0}) {
            CHECK(corners_of(naca({0.02, 0.4, 0.12, false}, n, clustering)) == Indices{0});
            CHECK(corners_of(naca({0, 0.4, 0.06, false}, n, clustering)) == Indices{0});
            CHECK(corners_of(fixtures::vectors(fixtures::joukowski(0.1, 0.05, n, clustering))) ==
                  Indices{0});
            for (int const n_base : {1, 2, 7})
                CHECK(corners_of(naca({0.04, 0.4, 0.15, true}, n, clustering, n_base)) ==
                      Indices{0, n_base});
        }
}

TEST_CASE("coordinates of six digits make no corners and lose none") {
    for (int const n : {100, 500, 2500}) {
        CHECK(corners_of(fixtures::rounded_to(naca({0, 0.4, 0.12, false}, n, 0.9), 6)) ==
              Indices{0});
        CHECK(corners_of(fixtures::rounded_to(naca({0, 0.4, 0.12, true}, n, 0.9), 6)) ==
              Indices{0, 4});
    }
}

TEST_CASE("rounded edges, ellipses and polygons with many equal bends have no corners") {
    for (double const radius : {1e-3, 5e-3})
        for (int const n_cap : {4, 8, 30})
            CHECK(corners_of(fixtures::rounded_edge(100, radius, n_cap)).empty());
    for (int const n : {16, 30, 31, 300})
        for (double const height : {0.2, 0.5, 1.0})
            CHECK(corners_of(fixtures::ellipse(n, height)).empty());
}

TEST_CASE("polygons have their corners, and bends of less than five degrees are none") {
    CHECK(corners_of(fixtures::polygon({{0.5, 0}, {0, 0.05}, {-0.5, 0}, {0, -0.05}}, 9)) ==
          Indices{0, 9, 18, 27});
    CHECK(corners_of(fixtures::polygon({{0.5, 0}, {0, 0.02}, {-0.5, 0}, {0, -0.02}}, 9)) ==
          Indices{0, 18});
    CHECK(corners_of({{0, 0}, {0.25, 0}, {0.5, 0}, {0.5, 0.25}, {0.5, 0.5}}, false) == Indices{2});
}

TEST_CASE("a short side is short and straight") {
    for (int const n_base : {1, 5}) {
        Measured const blunt(naca({0, 0.4, 0.12, true}, 50, 0.8, n_base));
        REQUIRE(blunt.corners.size() == 2);
        CHECK(is_straight_side(blunt.outline, blunt.corners[0], blunt.corners[1], .15));
        CHECK(!is_straight_side(blunt.outline, blunt.corners[1], blunt.corners[0], .15));
        CHECK(!is_straight_side(blunt.outline, blunt.corners[0], blunt.corners[0], .15));
    }
    Measured const square(fixtures::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}, 10));
    CHECK(!is_straight_side(square.outline, 0, 10, .15));  // too long
    Measured const bulging({{0, 0}, {1, 0.01}, {1.005, 0}, {1, -0.01}});
    CHECK(!is_straight_side(bulging.outline, 1, 3, .15));
}
