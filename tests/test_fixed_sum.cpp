// Sums in fixed point, and the scales that make them possible.
#include <doctest/doctest.h>

#include <fixtures/check.hpp>

#include <harmorph/fixed_sum.hpp>

#include <cmath>
#include <limits>
#include <random>

using harmorph::BinaryScale;
using harmorph::FixedSum;

namespace {

// What the kernels do with vectors, for one number.
FixedSum fixed(double t) {
    double const coarse = (t + FixedSum::coarse_grid) - FixedSum::coarse_grid;
    double const fine = ((t - coarse) + FixedSum::fine_grid) - FixedSum::fine_grid;
    return {static_cast<std::int64_t>(std::ldexp(coarse, 32)), static_cast<std::int64_t>(std::ldexp(fine, 64))};
}

}  // namespace

TEST_CASE("a number in fixed point is itself to 2^-65, and exactly so if it is not small") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 2000; ++k) {
        double const t = std::ldexp(uniform(random), -(k % 80));
        CHECK(std::fabs(fixed(t).value() - t) <= 0x1p-65);
        if (std::fabs(t) >= 0x1p-11) CHECK(fixed(t).value() == t);   // its last bit is 2^-64 or more
    }
    CHECK(fixed(1).value() == 1);
    CHECK(fixed(-1).value() == -1);
    CHECK(fixed(0x1p-66).value() == 0);
}

TEST_CASE("ties are rounded by the number alone, whatever the sum is") {
    double const tie = 0x1p-33, odd_tie = 3 * 0x1p-33;
    CHECK((fixed(tie).coarse == 0 && fixed(odd_tie).coarse == 2));
    CHECK((fixed(-tie).coarse == 0 && fixed(-odd_tie).coarse == -2));
    CHECK((fixed(0x1p-65).fine == 0 && fixed(3 * 0x1p-65).fine == 2));
}

TEST_CASE("values of sums: cancellation, carries, and 2^30 numbers of size 1") {
    std::int64_t const unit = std::int64_t{1} << 32, most = std::int64_t{1} << 30;
    CHECK(FixedSum{unit * most, 0}.value() == std::ldexp(1.0, 30));
    CHECK(FixedSum{-unit * most, 0}.value() == -std::ldexp(1.0, 30));
    CHECK(FixedSum{-1, unit}.value() == 0);
    CHECK(FixedSum{0, -1}.value() == -0x1p-64);
    CHECK(FixedSum{unit, 5 * unit + 3}.value() == 1 + 5 * 0x1p-32 + 0);   // 3 * 2^-64 is below the spacing at 1
    CHECK(FixedSum{0, most * (unit / 2)}.value() == 0.125);
}

TEST_CASE("scales: above every number, exact both ways") {
    double const largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::denorm_min();
    for (double const x : {1.0, 0.999, 1.5, -3.0, 1e-200, 1e300, largest, 7e-290}) {
        harmorph::Index const e = BinaryScale::exponent_above(x);
        CHECK(std::ilogb(x) + 1 == e);
    }
    for (double const x : {0.0, smallest, 1e-305}) CHECK(BinaryScale::exponent_above(x) == BinaryScale::least);
    CHECK(BinaryScale::exponent_above(std::nan("")) == BinaryScale::not_finite);
    CHECK(BinaryScale::exponent_above(-HUGE_VAL) == BinaryScale::not_finite);
    for (int const e : {-2000, -1023, -7, -1, 0, 1, 2, 513, 1023}) {
        BinaryScale const scale{e};
        CHECK(scale.valid());
        CHECK(scale.up(0.75) == std::ldexp(0.75, e));
        if (e > -1000) CHECK(scale.down(std::ldexp(0.75, e)) == 0.75);
    }
    CHECK(!BinaryScale{1024}.valid());
    CHECK(!BinaryScale{-2001}.valid());
    CHECK(BinaryScale::of_products(3, -5).exponent == -2);
    CHECK(!BinaryScale::of_products(1000, 24).finite());   // products might overflow
    CHECK(!BinaryScale::of_products(BinaryScale::not_finite, -1000).finite());
}

TEST_CASE("the largest magnitude: infinity is larger than all numbers, NaN larger than infinity") {
    harmorph::LargestMagnitude its;
    CHECK(its.value() == 0);
    for (double const x : {-2.0, 1.5, 0.0}) its.include(x);
    CHECK(its.value() == 2);
    its.include(-HUGE_VAL);
    its.include(1e300);
    CHECK(its.value() == HUGE_VAL);
    its.include(-std::nan(""));
    its.include(HUGE_VAL);
    CHECK(std::isnan(its.value()));
}
