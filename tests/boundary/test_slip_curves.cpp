// Curves through points of the boundary: they keep circles and straight lines,
// and the nearest place is the nearest one.
#include <doctest/doctest.h>

#include "boundary/slip.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace harmorph;

namespace {

class Curves {
public:
    Curves() {
        Arena counting;
        curves.lay_out(counting, 200, false);
        block_.resize(counting.bytes());
        Arena arena(block_.data(), block_.size());
        curves.lay_out(arena, 200, false);
        REQUIRE(!arena.overflown());
    }
    void add(std::vector<Vec2> const& points, bool closed) {
        auto const n = Index(points.size());
        curves.add(
            closed ? n : n - 1, closed, [&](Index k) { return points[std::size_t(k % n)]; },
            [&](Index k) { return k % n; });
    }
    SlipCurves curves;

private:
    std::vector<unsigned char> block_;
};

std::vector<Vec2> circle(int n, double radius, double from = 0, double to = 2 * pi) {
    std::vector<Vec2> out;
    for (int k = 0; k < n; ++k) {
        double const angle = from + (to - from) * k / n;
        out.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return out;
}

}  // namespace

TEST_CASE("a spline circle is off by at most 4.6e-6 at 45 degrees, falling with the sixth power") {
    double before = 0;
    for (int const n : {8, 16, 32}) {
        Curves curves;
        curves.add(circle(n, 3), true);
        CHECK(curves.curves.n_slots() == n + 1);
        double off = 0;
        for (int k = 0; k < 50; ++k) {
            double const angle = 2 * pi / n * k / 50;
            Vec2 const p{3.3 * std::cos(angle), 3.3 * std::sin(angle)};
            SlipCurves::Place const place = curves.curves.nearest(0, p);
            off = std::fmax(off, std::fabs(length(place.at) / 3 - 1));
            CHECK(std::fabs(dot(place.at, place.tangent)) < 2e-4);
            CHECK(std::fabs(place.stretch - 3 / 3.3) <
                  1e-2);  // radius of the circle / distance from its centre
        }
        if (n == 8) CHECK(off < 4.6e-6);
        if (n > 8) {
            CHECK(before / off > 50);
            CHECK(before / off < 80);
        }
        before = off;
    }
}

TEST_CASE("boundary points are on their curve bit by bit, and straight parts are straight") {
    Curves curves;
    std::vector<Vec2> points;
    for (int k = 0; k <= 5; ++k) points.push_back({0.1 * k, 0.3 * k});
    for (Vec2 const p : circle(10, 1, 0, pi / 2)) points.push_back({p.x + 5, p.y + 5});
    curves.add(points, false);
    for (Index slot = 0; slot < curves.curves.n_slots(); ++slot) {
        Vec2 const p = points[std::size_t(slot)];
        SlipCurves::Place const place = curves.curves.nearest(slot, p);
        CHECK(place.at.x == p.x);
        CHECK(place.at.y == p.y);
        CHECK(std::fabs(length(place.tangent) - 1) < 1e-15);
    }
    Vec2 const along{1 / std::sqrt(10.0), 3 / std::sqrt(10.0)};
    for (double const s : {-0.5, -0.01, 0.05, 0.3, 0.7}) {  // behind its end, too
        Vec2 const p{s * along.x - 0.1 * along.y, s * along.y + 0.1 * along.x};
        SlipCurves::Place const place = curves.curves.nearest(2, p);
        CHECK(std::fabs(place.at.x - s * along.x) < 1e-15);
        CHECK(std::fabs(place.at.y - s * along.y) < 1e-15);
        CHECK(std::fabs(place.stretch - 1) < 1e-14);
    }
}

TEST_CASE("the projected place is the nearest, and the derivative agrees with differences") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (bool const closed : {false, true}) {
        Curves curves;
        std::vector<Vec2> points = closed ? circle(20, 1) : std::vector<Vec2>();
        for (int k = 0; k < 20 && !closed; ++k)
            points.push_back({0.2 * k, 0.1 * std::sin(0.5 * k)});
        for (Vec2& p : points) p = {1.5 * p.x, p.y + 0.02 * p.x * p.x};
        curves.add(points, closed);
        for (int trial = 0; trial < 40; ++trial) {
            Index const slot = Index(19 * uniform(random));
            Vec2 const start = curves.curves.at[slot], way = curves.curves.tangent[slot];
            double const by = 0.8 * uniform(random) - 0.4, off = 0.2 * uniform(random) - 0.1;
            Vec2 const p{start.x + by * way.x - off * way.y, start.y + by * way.y + off * way.x};
            SlipCurves::Place const place = curves.curves.nearest(slot, p);
            double const distance = length(p - place.at);
            for (Index other = 0; other < 20; ++other)
                CHECK(distance <= length(p - curves.curves.at[other]) + 1e-15);
            CHECK(std::fabs(dot(p - place.at, place.tangent)) < 1e-14);
            double const h = 1e-5;
            for (Vec2 const d : {Vec2{h, 0}, Vec2{0, h}}) {
                Vec2 const change =
                    curves.curves.nearest(slot, p + d).at - curves.curves.nearest(slot, p - d).at;
                Vec2 const expected = (2 * place.stretch * dot(place.tangent, d)) * place.tangent;
                CHECK(length(change - expected) < 1e-3 * h);
            }
        }
    }
}

TEST_CASE("the search on a closed curve continues round the seam in both directions") {
    Curves curves;
    curves.add(circle(12, 1), true);
    for (Index const slot : {0, 1, 6, 11, 12}) {
        for (double const turn : {-100.0, -31.0, 29.0, 95.0}) {
            double const angle = (30.0 * slot + turn) * pi / 180;
            Vec2 const p{1.2 * std::cos(angle), 1.2 * std::sin(angle)};
            SlipCurves::Place const place = curves.curves.nearest(slot, p);
            CHECK(length((1 / 1.2) * p - place.at) < 1e-6);
        }
    }
}

TEST_CASE("each slot of several curves belongs to its own curve") {
    Curves curves;
    std::vector<Index> lasts;
    for (int k = 0; k < 5; ++k) {
        std::vector<Vec2> points = circle(6 + 2 * k, 1, 0, k % 2 == 0 ? 2 * pi : pi);
        for (Vec2& p : points) p.x += 10 * k;
        curves.add(points, k % 2 == 0);
        lasts.push_back(curves.curves.n_slots() - 1);
    }
    for (Index slot = 0; slot < curves.curves.n_slots(); ++slot) {
        INFO("slot " << slot);
        CHECK(curves.curves.is_last(slot) ==
              (std::find(lasts.begin(), lasts.end(), slot) != lasts.end()));
        Vec2 const at = curves.curves.at[slot], p = at + Vec2{1e-9, 1e-9};
        CHECK(length(curves.curves.nearest(slot, p).at - at) < 1e-8);
    }
}
