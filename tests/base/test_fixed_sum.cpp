// Sums in fixed point, and the scales that make them possible.
#include <doctest/doctest.h>

#include <fixtures/check.hpp>

#include "base/fixed_sum.hpp"

#include <limits>
#include <random>

using harmorph::BinaryScale;
using harmorph::FixedSum;

namespace {

// Computes for one number, in units of 2^63, the same as kernels whose instruction set has no such
// instruction.
FixedSum fixed(double t) {
    t = std::ldexp(t, 63);
    double const coarse = (t + FixedSum::coarse_grid) - FixedSum::coarse_grid;
    double const fine = ((t - coarse) + FixedSum::fine_grid) - FixedSum::fine_grid;
    return {std::int64_t(std::ldexp(coarse, -31)), std::int64_t(fine)};
}

}  // namespace

TEST_CASE("a number in fixed point is exact to 2^-64, and entirely exact unless it is small") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 2000; ++k) {
        double const t = std::ldexp(uniform(random), -(k % 80));
        CHECK(std::fabs(fixed(t).value() - t) <= 0x1p-64);
        if (std::fabs(t) >= 0x1p-10) CHECK(fixed(t).value() == t);  // its last bit is 2^-63 or more
        if (std::fabs(t) < 0.5) {  // the nearest integer, in one piece
            FixedSum const sum = fixed(t);
            CHECK(sum.coarse * (std::int64_t{1} << FixedSum::fine_bits) + sum.fine ==
                  std::llrint(std::ldexp(t, 63)));
        }
    }
    CHECK(fixed(1).value() == 1);
    CHECK(fixed(-1).value() == -1);
    CHECK(fixed(0x1p-65).value() == 0);
}

TEST_CASE("the number alone decides how a tie is rounded, whatever the sum is") {
    double const tie = 0x1p-33, odd_tie = 3 * 0x1p-33;
    CHECK(fixed(tie).coarse == 0);
    CHECK(fixed(odd_tie).coarse == 2);
    CHECK(fixed(-tie).coarse == 0);
    CHECK(fixed(-odd_tie).coarse == -2);
    CHECK(fixed(0x1p-64).fine == 0);
    CHECK(fixed(3 * 0x1p-64).fine == 2);
}

TEST_CASE("fixed sums are right with cancellation, with carries, and for 2^30 numbers of size 1") {
    std::int64_t const unit = std::int64_t{1} << 32, fine = std::int64_t{1} << FixedSum::fine_bits,
                       most = std::int64_t{1} << 30;
    CHECK(FixedSum{unit * most, 0}.value() == std::ldexp(1.0, 30));
    CHECK(FixedSum{-unit * most, 0}.value() == -std::ldexp(1.0, 30));
    CHECK(FixedSum{-1, fine}.value() == 0);
    CHECK(FixedSum{0, -1}.value() == -0x1p-63);
    CHECK(FixedSum{unit, 5 * fine + 3}.value() ==
          1 + 5 * 0x1p-32 + 0);  // 3 * 2^-63 is below the spacing at 1
    CHECK(FixedSum{0, most * (fine / 2)}.value() == 0.125);
    for (std::int64_t const carry : {-7, 0, 1, 1000})  // however a sum is split
        CHECK(FixedSum{3 * unit + 5 - carry, 77 + carry * fine}.value() ==
              FixedSum{3 * unit + 5, 77}.value());
}

TEST_CASE("a scale exceeds every number and converts exactly in both directions") {
    double const largest = std::numeric_limits<double>::max(),
                 smallest = std::numeric_limits<double>::denorm_min();
    for (double const x : {1.0, 0.999, 1.5, -3.0, 1e-200, 1e300, largest, 7e-286}) {
        harmorph::Index const e = BinaryScale::exponent_above(x);
        CHECK(std::ilogb(x) + 1 == e);
    }
    for (double const x : {0.0, smallest, 1e-305})
        CHECK(BinaryScale::exponent_above(x) == BinaryScale::min_exponent);
    CHECK(BinaryScale::exponent_above(std::nan("")) == BinaryScale::not_finite);
    CHECK(BinaryScale::exponent_above(-HUGE_VAL) == BinaryScale::not_finite);
    for (int const e : {-1901, -1023, -7, -1, 0, 1, 2, 513, 1023}) {
        BinaryScale const scale{e};
        CHECK(scale.valid());
        CHECK(scale.up(0.75) == std::ldexp(0.75, e));
        if (e > -1000) CHECK(scale.down(std::ldexp(0.75, e)) == 0.75);
    }
    CHECK(!BinaryScale{1024}.valid());
    CHECK(!BinaryScale{-1902}.valid());
    CHECK(BinaryScale{3}.units().down(1) == 0x1p+60);
    CHECK(!BinaryScale::of_products(0x1p+999, 0x1p+24).finite());  // products might overflow
    CHECK(!BinaryScale::of_products(HUGE_VAL, 0).finite());
    CHECK(!BinaryScale::of_products(1, std::nan("")).finite());
}

TEST_CASE("a scale of products exceeds every product, by less than a factor of 2") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(0.25, 4);
    for (int k = 0; k < 1000; ++k) {
        double const a = uniform(random), b = uniform(random);
        harmorph::Index const e = BinaryScale::of_products(a, b).exponent;
        CHECK(a * b < std::ldexp(1, e));
        CHECK(2 * a * b >= std::ldexp(1, e));
        CHECK(BinaryScale::of_products(a, b / 3).exponent <= e);  // of a part of the points
        CHECK(BinaryScale::of_products(std::ldexp(a, -800), std::ldexp(b, 700)).exponent ==
              e - 100);
    }
    CHECK(BinaryScale::of_products(1, 1).exponent == 1);
    CHECK(BinaryScale::of_products(0, 0).valid());
    double const tiny = std::numeric_limits<double>::denorm_min();
    CHECK(harmorph::is_finite(BinaryScale::of_products(tiny, 0x1p+900).units().down(0x1p+900)));
}

TEST_CASE("the largest magnitude ranks infinity above all numbers and NaN above infinity") {
    harmorph::LargestMagnitude largest;
    CHECK(largest.value() == 0);
    for (double const x : {-2.0, 1.5, 0.0}) largest.include(x);
    CHECK(largest.value() == 2);
    largest.include(-HUGE_VAL);
    largest.include(1e300);
    CHECK(largest.value() == HUGE_VAL);
    largest.include(-std::nan(""));
    largest.include(HUGE_VAL);
    CHECK(std::isnan(largest.value()));
}
