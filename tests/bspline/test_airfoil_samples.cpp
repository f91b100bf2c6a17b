#include <doctest/doctest.h>

#include "bspline/airfoil_samples.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

#include <algorithm>

using namespace harmorph;
using fixtures::naca;
using fixtures::Naca4;

namespace {

struct Sampled {
    std::unique_ptr<fixtures::Guarded> block;
    AirfoilSamples samples;
    Fault fault;
    Status status;

    explicit Sampled(std::vector<Vec2> const& points, bool is_loop = true) {
        auto const n = Index(points.size());
        block = fixtures::laid_out_part(samples, n, 400);
        status = samples.take({&points[0].x, &points[0].y, 2}, n, is_loop, fault);
    }
    std::vector<Vec2> line() const {
        std::vector<Vec2> out;
        for (Index k = 0; k < samples.line.n; ++k)
            out.push_back(samples.points.from_unit(samples.line.at[k]));
        return out;
    }
};

// Distance from the outline of a NACA section, by a fine polygon.
double distance_from(std::vector<Vec2> const& fine, Vec2 p) {
    double out = 9;
    for (Vec2 const& q : fine) out = std::fmin(out, length(p - q));
    return out;
}

}  // namespace

TEST_CASE("samples lie on the section between the points, and the shares distinguish the sides") {
    Naca4 const shape{0.04, 0.4, 0.12, false};
    Sampled const run(naca(shape, 30));
    REQUIRE_MESSAGE(!failed(run.status), run.fault.sentence);
    AirfoilLine const& line = run.samples.line;
    CHECK(run.samples.course.closure == Closure::tied);
    CHECK(line.n >= 400);
    std::vector<Vec2> const fine = naca(shape, 20000);
    for (Vec2 const& p : run.line()) CHECK(distance_from(fine, p) < 1e-4);
    CHECK(line.share[0] == 0);
    CHECK(line.share[line.n - 1] == 2);
    for (Index k = 1; k < line.n; ++k) CHECK(line.share[k] > line.share[k - 1]);
    for (double const wanted : {0.0, 0.3, 1.0, 1.7, 2.0}) {
        Real position = 0;
        Index const k = line.interval_of(wanted, position);
        double const found = line.share[k] + position * (line.share[k + 1] - line.share[k]);
        CHECK(std::fabs(found - wanted) < 1e-14);
    }
    CHECK(length(run.samples.points.from_unit(line.trailing) - Vec2{1, 0}) < 1e-14);
    CHECK(length(run.samples.points.from_unit(line.leading)) < 5e-3);
}

TEST_CASE("the leading edge moves smoothly with the section, whichever point is the farthest") {
    auto const leading = [](std::vector<Vec2> const& points) {
        Sampled const run(points);
        REQUIRE_MESSAGE(!failed(run.status), run.fault.sentence);
        return run.samples.points.from_unit(run.samples.line.leading);
    };
    double largest = 0;
    for (int k = 0; k <= 140; ++k) {
        Naca4 const shape{0.0005 * k, 0.4, 0.12, false};
        std::vector<Vec2> const fine = naca(shape, 20000);
        Vec2 farthest{1, 0};
        for (Vec2 const p : fine) {
            if (length(p - Vec2{1, 0}) > length(farthest - Vec2{1, 0})) farthest = p;
        }
        largest = std::fmax(largest, length(leading(naca(shape, 80)) - farthest));
    }
    // The samples are 2e-4 to 1e-3 apart there.
    CHECK(largest < 2e-5);
    // A sharp leading edge is a point of the section.
    CHECK(length(leading({{1, 0}, {0.4, 0.05}, {0, 0.013}, {0.5, -0.04}}) - Vec2{0, 0.013}) <
          1e-14);
}

TEST_CASE(
    "samples of a line at one place, as of a curve that stands still, keep all numbers finite") {
    std::vector<Vec2> points = {{1, 0}, {0.5, 0.1}, {0, 0}, {0, 0}, {0.5, -0.1}, {1, 0}};
    std::vector<double> shares(points.size());
    AirfoilLine line;
    line.at = {points.data(), points.size()};
    line.share = {shares.data(), shares.size()};
    line.n = Index(points.size());
    CHECK(line.measure());
    CHECK(length(line.leading) == 0);
    for (std::size_t k = 1; k < shares.size(); ++k) CHECK(shares[k] >= shares[k - 1]);
    CHECK(shares.back() == 2);
}

TEST_CASE("a loop may begin anywhere and run either way, and a closed line may begin elsewhere") {
    std::vector<Vec2> points = naca({0.02, 0.4, 0.12, false}, 40);
    Sampled const first(points);
    std::rotate(points.begin(), points.begin() + 23, points.end());
    Sampled const rotated(points);
    REQUIRE(rotated.samples.line.n == first.samples.line.n);
    std::vector<Vec2> const a = first.line(), b = rotated.line();
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(length(a[k] - b[k]) < 1e-12);
    std::reverse(points.begin(), points.end());
    Sampled const reversed(points);
    CHECK(reversed.samples.line.runs_clockwise() != first.samples.line.runs_clockwise());
    std::vector<Vec2> c = reversed.line();
    std::reverse(c.begin(), c.end());
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(length(a[k] - c[k]) < 1e-12);

    Sampled ellipse(fixtures::ellipse(60, 0.3));
    REQUIRE(ellipse.samples.course.closure == Closure::periodic);
    ellipse.samples.begin_at_farthest({-1, 0});
    CHECK(length(ellipse.line().front() - Vec2{-0.5, 0}) < 1e-5);
    CHECK(length(ellipse.line().front() - ellipse.line().back()) == 0);
}

TEST_CASE("a blunt base is left out, and open points end at their ends") {
    Naca4 const blunt{0, 0.4, 0.12, true};
    Sampled const loop(naca(blunt, 40));
    CHECK(loop.samples.course.closure == Closure::open);
    std::vector<Vec2> const line = loop.line();
    double const height = fixtures::naca4_point(blunt, 1, 1).y;
    CHECK(std::fabs(std::fabs(line.front().y) - height) < 1e-14);
    CHECK(std::fabs(line.front().y + line.back().y) < 1e-14);
    std::vector<Vec2> points = naca({0, 0.4, 0.12, false}, 40);
    points.push_back({1, -0.001});
    points.front() = {1, 0.001};
    Sampled const open(points, false);
    CHECK(length(open.line().front() - points.front()) < 1e-14);
    CHECK(length(open.line().back() - points.back()) < 1e-14);
}
