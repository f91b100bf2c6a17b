#include <doctest/doctest.h>

#include "bspline/airfoil_samples.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

using namespace harmorph;
using fixtures::pi;

namespace {

struct SplineRun {
    std::unique_ptr<fixtures::Guarded> block;
    PointSpline spline;

    SplineRun(std::vector<Vec2> const& points, bool is_closed) {
        auto const n = Index(points.size());
        block = fixtures::laid_out_part(spline, n);
        spline.pass_through({points.data(), points.size()}, is_closed);
    }
};

std::vector<Vec2> arc(int n, double angle) {
    std::vector<Vec2> out;
    for (int k = 0; k <= n; ++k) out.push_back({std::cos(angle * k / n), std::sin(angle * k / n)});
    return out;
}

double largest_error(int n, double angle, bool is_closed) {
    std::vector<Vec2> points = arc(n, angle);
    if (is_closed) points.back() = points.front();
    SplineRun const run(points, is_closed);
    double out = 0;
    for (int k = 0; k < n; ++k)
        for (double const share : {0.25, 0.5, 0.75})
            out = std::fmax(out, std::fabs(length(run.spline.at(k, share)) - 1));
    return out;
}

}  // namespace

TEST_CASE("the spline passes through the points, and straight lines stay straight") {
    std::vector<Vec2> const points = {{0, 0}, {1, 2}, {1.5, 3}, {4, 8}};
    SplineRun const run(points, false);
    for (Index k = 0; k < 3; ++k) {
        CHECK(length(run.spline.at(k, 0) - points[std::size_t(k)]) == 0);
        CHECK(length(run.spline.at(k, 1) - points[std::size_t(k) + 1]) == 0);
        Vec2 const middle = run.spline.at(k, 0.3);
        CHECK(std::fabs(middle.y - 2 * middle.x) < 1e-14);
    }
    std::vector<Vec2> const ends = {{0, 0}, {1, 1}};
    SplineRun const two(ends, false);
    CHECK(length(two.spline.at(0, 0.5) - Vec2{0.5, 0.5}) < 1e-16);
}

TEST_CASE("the order of the error on a circle is four when closed, and three with ends") {
    for (int const n : {8, 16, 32}) {
        CHECK(largest_error(n, 2 * pi, true) > 14 * largest_error(2 * n, 2 * pi, true));
        CHECK(largest_error(n, pi, false) > 7 * largest_error(2 * n, pi, false));
    }
    CHECK(largest_error(64, 2 * pi, true) < 1e-6);
}
