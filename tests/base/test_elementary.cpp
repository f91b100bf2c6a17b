#include <doctest/doctest.h>

#include "base/elementary.hpp"

#include <cmath>
#include <random>

using namespace harmorph;

TEST_CASE("elementary functions agree with the mathematics library but for a few last bits") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int trial = 0; trial < 20000; ++trial) {
        double const x = unit(random), wide = std::exp(1200 * (x - 0.5)),
                     y = 20 * (unit(random) - 0.5);
        CHECK(std::fabs(logarithm(wide) - std::log(wide)) <=
              4e-16 * std::fabs(std::log(wide)) + 1e-17);
        CHECK(std::fabs(logarithm(0.9 + 0.2 * x) - std::log(0.9 + 0.2 * x)) <=
              2e-15 * std::fabs(std::log(0.9 + 0.2 * x)) + 1e-17);
        CHECK(std::fabs(exponential(1300 * (x - 0.5)) / std::exp(1300 * (x - 0.5)) - 1) <= 2e-15);
        CHECK(std::fabs(power(x, y) / std::pow(x, y) - 1) <=
              1e-14 * (1 + std::fabs(y * std::log(x))));
        CHECK(std::fabs(sine_of_pi(x) - std::sin(std::acos(-1.0) * x)) <= 4e-16);
    }
    CHECK(logarithm(1) == 0);
    CHECK(exponential(0) == 1);
    CHECK(exponential(-1e9) == 0);
    CHECK(power(0, 0) == 1);
    CHECK(power(0, 0.5) == 0);
    CHECK(power(1, 7) == 1);
    CHECK(sine_of_pi(0) == 0);
    CHECK(sine_of_pi(1) == 0);
}
