#include <doctest/doctest.h>

#include "bspline/projection.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

#include <algorithm>

using namespace harmorph;
using fixtures::Spline;

namespace {

struct Chained {
    std::vector<double> u;
    double sum = 0;
};

Chained chain(Curve const& curve, std::vector<Vec2> const& points, bool is_loop) {
    auto const n = Index(points.size());
    ChainWork work;
    auto const block = fixtures::laid_out_part(work, n);
    Chained out;
    out.u.resize(points.size());
    out.sum = project_chain(curve, {points.data(), points.size()}, is_loop, work,
                            {out.u.data(), out.u.size()});
    return out;
}

// Steps against the direction that most steps have: 0 where monotone, 1 where the chain passes the
// seam.
int turns_back(std::vector<double> const& u, bool is_loop) {
    int up = 0, down = 0;
    std::size_t const n = u.size();
    for (std::size_t k = 0; k + (is_loop ? 0 : 1) < n; ++k) {
        up += u[(k + 1) % n] > u[k] ? 1 : 0;
        down += u[(k + 1) % n] < u[k] ? 1 : 0;
    }
    return std::min(up, down);
}

std::vector<Vec2> points_on(Curve const& curve, int n, double first, double part = 1) {
    std::vector<Vec2> out;
    double const range = curve.end() - curve.begin();
    for (int k = 0; k < n; ++k)
        out.push_back(
            curve_point(curve, curve.begin() + range * std::fmod(first + part * k / n, 1.0)));
    return out;
}

// Two sides 1e-4 apart, tied at (1, 0): wall points with an offset larger than that would land on
// the wrong side.
Spline thin_blade() {
    Spline out;
    out.degree = 3;
    out.control = {1,    0, 0.9, 5e-5, 0.6, 5e-5,  0.3, 5e-5,  0,   0.1,
                   -0.1, 0, 0,   -0.1, 0.3, -5e-5, 0.6, -5e-5, 0.9, -5e-5};
    for (int k = 0; k < 10; ++k) out.indices.push_back(k);
    out.indices.push_back(0);
    out.knots = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8};
    return out;
}

}  // namespace

TEST_CASE("points along an open curve are projected forwards and backwards") {
    Spline const spline = fixtures::clamped(3, 12, 1);
    Curve const curve = spline.curve();
    std::vector<Vec2> points = points_on(curve, 50, 0, 1);
    points.push_back(curve_point(curve, curve.end()));
    Chained const forwards = chain(curve, points, false);
    std::reverse(points.begin(), points.end());
    Chained backwards = chain(curve, points, false);
    CHECK(forwards.u.front() == curve.begin());
    CHECK(forwards.u.back() == curve.end());
    CHECK(turns_back(forwards.u, false) == 0);
    CHECK(forwards.sum < 1e-25);
    std::reverse(backwards.u.begin(), backwards.u.end());
    CHECK(forwards.u == backwards.u);
}

TEST_CASE("a loop on a periodic curve passes the seam once, wherever the loop begins") {
    Spline const spline = fixtures::periodic(3, 10, 0.3, 2);
    Curve const curve = spline.curve();
    for (double const first : {0.0, 0.003, 0.31, 0.5, 0.999}) {
        std::vector<Vec2> points = points_on(curve, 77, first);
        for (int direction = 0; direction < 2; ++direction) {
            Chained const found = chain(curve, points, true);
            CHECK(found.sum < 1e-25);
            CHECK(turns_back(found.u, true) == 1);
            std::reverse(points.begin(), points.end());
        }
    }
}

TEST_CASE("an open piece of a periodic curve may pass its seam") {
    Spline const spline = fixtures::periodic(3, 10, 0.3, 3);
    Curve const curve = spline.curve();
    for (double const first : {0.0, 0.2, 0.7, 0.95}) {
        std::vector<Vec2> const points = points_on(curve, 40, first, 0.4);
        Chained const found = chain(curve, points, false);
        CHECK(found.sum < 1e-25);
        CHECK(turns_back(found.u, false) == (first > 0.6 ? 1 : 0));
    }
}

TEST_CASE("on a tied curve the nearest point of a loop has the tied end") {
    Spline const spline = thin_blade();
    Curve const curve = spline.curve();
    std::vector<Vec2> points = points_on(curve, 60, 0);
    points[0] = points[0] +
                Vec2{2e-3, 1e-3};  // off, and nearer to the upper side than to the tied end itself
    for (std::size_t const start : {0u, 13u, 59u})
        for (int direction = 0; direction < 2; ++direction) {
            std::vector<Vec2> turned = points;
            std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start),
                        turned.end());
            if (direction == 1) std::reverse(turned.begin(), turned.end());
            Chained const found = chain(curve, turned, true);
            CHECK(turns_back(found.u, true) == 1);
            std::size_t const tied = direction == 0 ? (60 - start) % 60 : 59 - (60 - start) % 60;
            CHECK(found.u[tied] == curve.begin());
        }
}

TEST_CASE("a thin trailing edge does not flip points to the other side") {
    Spline const spline = thin_blade();
    Curve const curve = spline.curve();
    std::mt19937 random(4);
    std::uniform_real_distribution<double> noise(-1e-4, 1e-4);
    int flipped_alone = 0;
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<double> exact;
        std::vector<Vec2> points;
        for (int k = 0; k < 200; ++k) {
            exact.push_back(8.0 * k / 200);
            points.push_back(curve_point(curve, exact.back()) +
                             Vec2{0, k == 0 ? 0 : noise(random)});
        }
        Chained const found = chain(curve, points, true);
        for (std::size_t k = 0; k < 200; ++k) {
            CHECK(std::fabs(found.u[k] - exact[k]) < 0.05);
            flipped_alone += std::fabs(project(curve, points[k]).u - exact[k]) > 1 ? 1 : 0;
        }
    }
    CHECK(flipped_alone > 100);  // the test is not an easy one
}

TEST_CASE("the seam may be within a thin part") {
    Spline const ring = fixtures::periodic(3, 24, 2e-4, 5);
    Curve const curve = ring.curve();
    std::mt19937 random(6);
    std::uniform_real_distribution<double> noise(-1e-4, 1e-4);
    for (double const first : {0.01, 0.26, 0.6}) {
        std::vector<Vec2> points = points_on(curve, 150, first);
        for (Vec2& p : points) p.y += noise(random);
        Chained const found = chain(curve, points, true);
        CHECK(turns_back(found.u, true) == 1);
        for (int k = 0; k < 150; ++k) {
            double const exact = 24 * std::fmod(first + k / 150.0, 1.0);
            double const off = std::fabs(found.u[std::size_t(k)] - exact);
            CHECK(std::fmin(off, 24 - off) < 1.5);
        }
    }
}

TEST_CASE("no points, one point, and points all in one place are projected") {
    Spline const spline = thin_blade();
    Curve const curve = spline.curve();
    CHECK(chain(curve, {}, true).sum == 0);
    CHECK(chain(curve, {{1, 0}}, true).u[0] == curve.begin());
    Chained const same = chain(curve, {{0.5, 1}, {0.5, 1}, {0.5, 1}}, false);
    CHECK(same.u[0] == same.u[1]);
    CHECK(same.u[1] == same.u[2]);
}
