// Sums and products of two doubles keep all bits; the other operations lose a few of 106 bits.
#include <doctest/doctest.h>

#include <fixtures/double_double.hpp>

#include "base/double_double.hpp"

#include <cmath>
#include <random>

using harmorph::DoubleDouble;

TEST_CASE("sums and products of two doubles are exact") {
    CHECK(DoubleDouble::sum(1, 0x1p-80).low == 0x1p-80);
    CHECK(DoubleDouble::difference(0x1p-80, 1).high == -1);
    double const a = 1 + 0x1p-40, b = 1 - 0x1p-30;
    DoubleDouble const product = DoubleDouble::product(a, b);
    CHECK(product.high == a * b);
    CHECK(product.low == -0x1p-70);  // 1 + 2^-40 - 2^-30 is a double
}

TEST_CASE("operations on numbers of twice the precision") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 1000; ++k) {
        DoubleDouble const x = DoubleDouble::sum(uniform(random), 0x1p-54 * uniform(random)),
                           y = DoubleDouble::sum(uniform(random), 0x1p-54 * uniform(random));
        double const divisor = 1.5 + uniform(random);
        auto const wide = [](DoubleDouble a) {
            return fixtures::DoubleDouble(a.high) + fixtures::DoubleDouble(a.low);
        };
        auto const error = [&](DoubleDouble found, fixtures::DoubleDouble expected) {
            return std::fabs((wide(found) - expected).high);
        };
        CHECK(error(x + y, wide(x) + wide(y)) <= 0x1p-100);
        CHECK(error(x - y, wide(x) - wide(y)) <= 0x1p-100);
        CHECK(error(x * y, wide(x) * wide(y)) <= 0x1p-100);
        CHECK(error(x / divisor, wide(x) / fixtures::DoubleDouble(divisor)) <= 0x1p-98);
        CHECK((x - x).rounded() == 0);
        CHECK(!std::signbit((-(x - x)).rounded()));
    }
}
