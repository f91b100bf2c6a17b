// The bound by which seeded movements are left out: no mesh is better, and the best one attains it.
#include <doctest/doctest.h>

#include "../deform/wall_bound.hpp"

#include <random>

using namespace deform;

namespace {

double const pi = std::acos(-1.0);

double quality_of(const std::vector<double>& x, const std::vector<double>& y) {
    std::size_t const n = x.size();
    double squares = 0, sines = 0, area = 0;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t const a = (k + n - 1) % n, b = (k + 1) % n;
        double const ux = x[a] - x[k], uy = y[a] - y[k], vx = x[b] - x[k], vy = y[b] - y[k];
        area = vx * uy - vy * ux;
        if (!(area > 0)) return 0;
        squares += vx * vx + vy * vy;
        sines += std::hypot(ux, uy) * std::hypot(vx, vy) / area;
    }
    return n == 3 ? 2 * std::sqrt(3.0) * area / squares : 4 / sines;
}

}  // namespace

TEST_CASE("no cell with this angle is better, and one is as good") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (double const angle : {0.01, 0.2, 0.7, 1.0}) {
        for (int const n : {3, 4}) {
            double const bound = best_quality(angle, n == 3 ? 1 : 0, n == 3 ? 0 : 1);
            CHECK(least_angle(n, bound) == doctest::Approx(angle).epsilon(1e-9));
            double best = 0;
            for (int trial = 0; trial < 20000; ++trial) {
                double const a = std::pow(10, uniform(random) - 0.5);
                double const b = trial < 10 ? a : std::pow(10, uniform(random) - 0.5);
                std::vector<double> x = {0, a, b * std::cos(angle)}, y = {0, 0, b * std::sin(angle)};
                if (n == 4) {
                    double const s = 3 * uniform(random), t = 3 * uniform(random);
                    x.insert(x.begin() + 2, s * x[1] + t * x[2]);
                    y.insert(y.begin() + 2, s * y[1] + t * y[2]);
                }
                best = std::fmax(best, quality_of(x, y));
                CHECK(quality_of(x, y) <= bound * (1 + 1e-12));
            }
            if (n == 3) CHECK(best > 0.999 * bound);
        }
    }
    CHECK(best_quality(pi / 3, 1, 0) > 1 - 1e-9);
    CHECK(best_quality(pi / 2, 0, 1) > 1 - 1e-9);
    CHECK(best_quality(0.06, 3, 0) == doctest::Approx(best_quality(0.02, 1, 0)));
    CHECK(best_quality(0.06, 1, 1) < best_quality(0.06, 1, 0));
}

TEST_CASE("no triangle on a side of this length is better, and one is as good") {
    for (double const length : {0.05, 0.7, 1.0, 3.0, 50.0}) {
        double const area = 0.4, bound = best_on_side(length, area);
        double best = 0;
        for (int i = -30; i <= 30; ++i)
            for (int j = 1; j <= 4000; ++j) {
                double const h = length * std::pow(10, -4 + 0.002 * j), x = length * (0.5 + 0.05 * i);
                double const skew = quality_of({0, length, x}, {0, 0, h}), ratio = 0.5 * length * h / area;
                best = std::fmax(best, skew * std::sqrt(std::fmin(ratio, 1 / ratio)));
            }
        CHECK(best <= bound * (1 + 1e-12));
        CHECK(best > 0.999 * bound);
    }
    CHECK(best_on_side(1, std::sqrt(3.0) / 4) < 1 + 1e-12);
    CHECK(best_on_side(1, std::sqrt(3.0) / 4) > 1 - 1e-12);
}

TEST_CASE("where a wall folds: the sharpest corner of the mesh's side, on whichever side that is") {
    // Four triangles above a wall of three points, and the mirror image.
    for (double const side : {1.0, -1.0}) {
        std::vector<double> const x = {-1, 0, 1, 1, -1, 0}, y = {0, 0, 0, side, side, side};
        std::vector<int> cells = {0, 1, 4, 1, 5, 4, 1, 3, 5, 1, 2, 3};
        if (side < 0)
            for (std::size_t k = 0; k < cells.size(); k += 3) std::swap(cells[k], cells[k + 1]);
        for (double const fold : {10.0, 100.0, 300.0}) {   // degrees on the mesh's side, symmetric about the y axis
            double const half = fold * pi / 360;
            std::vector<double> wall_x = x, wall_y = y;
            wall_x[0] = -std::sin(half);
            wall_x[2] = std::sin(half);
            wall_y[0] = wall_y[2] = side * std::cos(half);
            WallBound const bound({0, 3, 6, 9, 12}, cells, {0, 1, 1, 2}, {7, 7}, 7, x, y, wall_x, wall_y);
            CHECK(bound.quality == doctest::Approx(std::fmin(best_quality(fold * pi / 180, 4, 0), best_on_side(1, 0.5))));
            if (bound.angle > 0) {
                CHECK(bound.point == 1);
                CHECK(bound.angle == doctest::Approx(fold));
            }
            CHECK((bound.angle > 0) == (fold < 150));
        }
    }
}
