// The bound by which seeded movements are left out: no mesh is better, and the best one attains it.
#include <doctest/doctest.h>

#include "measure/deform/wall_bound.hpp"

#include <random>

using namespace deform;

namespace {

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

TEST_CASE("no cell with a given angle is better than the bound, and one is as good") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (double const angle : {0.01, 0.2, 0.7, 1.0}) {
        for (int const n : {3, 4}) {
            double const bound = best_quality(angle, n == 3 ? 1 : 0, n == 3 ? 0 : 1);
            CHECK(min_angle(n, bound) == doctest::Approx(angle).epsilon(1e-9));
            double best = 0;
            for (int trial = 0; trial < 20000; ++trial) {
                double const a = std::pow(10, uniform(random) - 0.5);
                double const b = trial < 10 ? a : std::pow(10, uniform(random) - 0.5);
                std::vector<double> x = {0, a, b * std::cos(angle)},
                                    y = {0, 0, b * std::sin(angle)};
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

TEST_CASE("no triangle on a side of given length is better than the bound, and one is as good") {
    for (double const length : {0.05, 0.7, 1.0, 3.0, 50.0}) {
        double const area = 0.4, bound = best_on_side(length, area);
        double best = 0;
        for (int i = -30; i <= 30; ++i)
            for (int j = 1; j <= 4000; ++j) {
                double const h = length * std::pow(10, -4 + 0.002 * j),
                             x = length * (0.5 + 0.05 * i);
                double const skew = quality_of({0, length, x}, {0, 0, h}),
                             ratio = 0.5 * length * h / area;
                best = std::fmax(best, skew * std::sqrt(std::fmin(ratio, 1 / ratio)));
            }
        CHECK(best <= bound * (1 + 1e-12));
        CHECK(best > 0.99 * bound);
    }
    CHECK(best_on_side(1, std::sqrt(3.0) / 4) == 1);
}

TEST_CASE("no triangle on a side without the given points is better; one is close") {
    double const length = 2, area = 0.4;
    // The cotangents of (x, y) above the side from (0, 0) to (length, 0).
    auto const cotangents = [&](double x, double y) { return std::pair(x / y, (length - x) / y); };
    auto const is_inside = [&](double x, double y, double top_x, double top_y) {
        auto const point = cotangents(x, y), top = cotangents(top_x, top_y);
        return top.first < point.first && top.second < point.second;
    };
    double last = best_on_side(length, area);
    std::vector<std::pair<double, double>> places;
    for (auto const& place :
         {std::pair(0.7, 0.3), std::pair(1.3, 0.1), std::pair(1.0, 0.04), std::pair(0.2, 0.01)}) {
        places.push_back(place);
        std::vector<std::pair<double, double>> points;
        for (auto const& [x, y] : places) points.push_back(cotangents(x, y));
        double const bound = best_on_side(length, area, points);
        double best = 0;
        for (int i = -200; i <= 200; ++i)
            for (int j = 1; j <= 600; ++j) {
                double const h = std::pow(10, -4 + 0.01 * j), x = length * (0.5 + 0.01 * i);
                bool contains = false;
                for (auto const& place_inside : places)
                    contains = contains || is_inside(place_inside.first, place_inside.second, x, h);
                if (contains) continue;
                double const skew = quality_of({0, length, x}, {0, 0, h}),
                             ratio = 0.5 * length * h / area;
                best = std::fmax(best, skew * std::sqrt(std::fmin(ratio, 1 / ratio)));
            }
        INFO(best << " of " << bound);
        CHECK(best <= bound * (1 + 1e-12));
        CHECK(best > 0.95 * bound);
        CHECK(bound <= last);
        last = bound;
    }
    CHECK(last < 0.5 * best_on_side(length, area));
}

TEST_CASE("no cell with an angle near 180 degrees is better; no such quadrilateral is, either") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    double const length = 1, area = 1e-3;
    for (double const e : {0.02, 0.1, 0.5}) {
        double const angle = pi - e, bound = best_quad_with_wide_angle(angle, length, area);
        double best[2] = {0, 0}, sized = 0;
        for (int trial = 0; trial < 400000; ++trial) {
            double const b = std::pow(10, 1 - 4 * uniform(random)),
                         s = std::pow(10, 1 - 5 * uniform(random));
            double const direction = uniform(random) * pi;
            double const x = b * std::cos(angle), y = b * std::sin(angle);
            best[0] = std::fmax(best[0], quality_of({0, b, length * std::cos(angle)},
                                                    {0, 0, length * std::sin(angle)}));
            double const end_x = length + s * std::cos(direction), end_y = s * std::sin(direction);
            double const skew = quality_of({0, length, end_x, x}, {0, 0, end_y, y});
            double const cell_area = 0.5 * (end_x * y - end_y * x + length * end_y);
            best[1] = std::fmax(best[1], skew);
            if (skew > 0) sized = std::fmax(sized, skew * size_quality(cell_area, area));
        }
        INFO(e << ": " << sized << " of " << bound);
        CHECK(best[0] <= best_with_wide_angle(3, angle) * (1 + 1e-12));
        CHECK(best[1] <= best_with_wide_angle(4, angle) * (1 + 1e-12));
        CHECK(sized <= bound * (1 + 1e-12));
        CHECK(sized > 0.6 * bound);
        CHECK(bound <= best_with_wide_angle(4, angle) * 1.1);
        CHECK(bound < 0.9);
    }
    CHECK(best_with_wide_angle(3, pi / 3) == 1);
    CHECK(best_with_wide_angle(4, pi / 2) == 1);
    CHECK(best_with_wide_angle(4, pi) == 0);
}

TEST_CASE("at a folded wall the sharpest corner of the mesh's side counts, on either side") {
    // Four triangles above a wall of three points, and the mirror image.
    for (double const side : {1.0, -1.0}) {
        std::vector<double> const x = {-1, 0, 1, 1, -1, 0}, y = {0, 0, 0, side, side, side};
        std::vector<int> cells = {0, 1, 4, 1, 5, 4, 1, 3, 5, 1, 2, 3};
        if (side < 0)
            for (std::size_t k = 0; k < cells.size(); k += 3) std::swap(cells[k], cells[k + 1]);
        for (double const fold :
             {10.0, 100.0, 300.0}) {  // degrees on the mesh's side, symmetric about the y axis
            double const half = fold * pi / 360;
            std::vector<double> wall_x = x, wall_y = y;
            wall_x[0] = -std::sin(half);
            wall_x[2] = std::sin(half);
            wall_y[0] = wall_y[2] = side * std::cos(half);
            WallBound const bound({0, 3, 6, 9, 12}, cells, {0, 1, 1, 2}, {7, 7}, 7, x, y, wall_x,
                                  wall_y);
            double const share = fold * pi / 180 / 4;
            double const angles =
                std::fmin(best_quality(4 * share, 4, 0), best_with_wide_angle(3, share));
            CHECK(bound.quality == doctest::Approx(std::fmin(angles, best_on_side(1, 0.5))));
            CHECK(bound.point == 1);
            CHECK(bound.angle == doctest::Approx(fold));
        }
    }
}
