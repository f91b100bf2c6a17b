// Angles against the mathematics library.
#include <doctest/doctest.h>

#include "base/vec2.hpp"

#include <cmath>
#include <initializer_list>

using harmorph::angle_of;

TEST_CASE("angles agree with the mathematics library in all directions and at any length") {
    double worst = 0;
    for (int k = -20000; k <= 20000; ++k) {
        double const angle = std::acos(-1.0) * k / 20000;
        for (double const r : {1.0, 1e-200, 3e250}) {
            double const x = r * std::cos(angle), y = r * std::sin(angle);
            worst = std::fmax(worst, std::fabs(angle_of({x, y}) - std::atan2(y, x)));
        }
    }
    CHECK(worst < 2e-15);  // the last place of pi is 4e-16
}

TEST_CASE("small angles keep their digits, angles of axes are exact, and signs follow reflection") {
    for (double const y : {1e-300, 1e-20, 1e-9, 0.1}) {
        CHECK(angle_of({1, y}) == doctest::Approx(std::atan2(y, 1)).epsilon(1e-15));
        CHECK(angle_of({1, -y}) == -angle_of({1, y}));
        CHECK(angle_of({-1, -y}) == -angle_of({-1, y}));
    }
    CHECK(angle_of({2, 0}) == 0);
    CHECK(angle_of({0, 3}) == doctest::Approx(harmorph::pi / 2).epsilon(1e-15));
    CHECK(angle_of({-1, 0}) == doctest::Approx(harmorph::pi).epsilon(1e-15));
    CHECK(angle_of({0, 0}) == 0);
    CHECK(harmorph::in_degrees(harmorph::pi) == doctest::Approx(180).epsilon(1e-15));
}
