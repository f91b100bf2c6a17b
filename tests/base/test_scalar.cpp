// Functions of numbers, the range of the caller's numbers, and vectors of space.
#include <doctest/doctest.h>

#include "base/types.hpp"
#include "base/vec2.hpp"
#include "base/vec3.hpp"

#include <initializer_list>
#include <limits>

using namespace harmorph;

namespace {

constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();
constexpr Real tiny = std::numeric_limits<Real>::denorm_min();

}  // namespace

TEST_CASE("only infinities and NaN are not finite") {
    for (Real const x : {0.0, -0.0, 1.0, -1e308, tiny, std::numeric_limits<Real>::max()})
        CHECK(is_finite(x));
    for (Real const x : {infinity, -infinity, not_a_number, -not_a_number}) CHECK(!is_finite(x));
}

TEST_CASE("the power of two of a number is the largest that does not exceed the number") {
    CHECK(power_of_two_at(1) == 1);
    CHECK(power_of_two_at(1.999) == 1);
    CHECK(power_of_two_at(2) == 2);
    CHECK(power_of_two_at(0.3) == 0.25);
    CHECK(power_of_two_at(1e300) <= 1e300);
    CHECK(2 * power_of_two_at(1e300) > 1e300);
}

TEST_CASE("NaN exceeds all numbers, and nothing exceeds NaN") {
    CHECK(exceeds(2, 1));
    CHECK(!exceeds(1, 1));
    CHECK(exceeds(not_a_number, infinity));
    CHECK(!exceeds(1, not_a_number));
    CHECK(!exceeds(not_a_number, not_a_number));
}

TEST_CASE("clamping keeps numbers in range and moves others to the nearer bound") {
    CHECK(clamp(0.5, 0.0, 1.0) == 0.5);
    CHECK(clamp(-2.0, 0.0, 1.0) == 0);
    CHECK(clamp(7, 0, 3) == 3);
}

TEST_CASE("the bounds belong to the range of an argument, and NaN and infinities never do") {
    CHECK(is_at_most(-1, 1));
    CHECK(!is_at_most(1.0001, 1));
    CHECK(is_between(1, 1, 2));
    CHECK(is_between(1, 2, 2));
    CHECK(!is_between(1, 0.9999, 2));
    CHECK(is_coordinate({largest_coordinate, -largest_coordinate}));
    CHECK(!is_coordinate({0, 1.0001 * largest_coordinate}));
    for (Real const x : {infinity, -infinity, not_a_number}) {
        CHECK(!is_at_most(x, infinity));
        CHECK(!is_between(-infinity, x, infinity));
        CHECK(!is_coordinate({x, 0}));
        CHECK(!is_coordinate({0, x}));
    }
}

TEST_CASE("a set contains the values that it was made of") {
    enum class Colour : unsigned { red, green, blue };
    unsigned const set = set_of(Colour::red, Colour::blue);
    CHECK(contains(set, Colour::red));
    CHECK(!contains(set, Colour::green));
    CHECK(contains(set, Colour::blue));
    int const rows[2] = {};
    CHECK(!has_row(rows, -1));
    CHECK(has_row(rows, 1));
    CHECK(!has_row(rows, 2));
}

TEST_CASE("lengths and directions in space do not overflow or underflow") {
    for (Real const size : {1.0, 1e200, 1e-200}) {
        Vec3 const v{2 * size, 3 * size, -6 * size};
        CHECK(length(v) == doctest::Approx(7 * size).epsilon(1e-15));
        Vec3 const unit = direction(v);
        CHECK(length(unit) == doctest::Approx(1).epsilon(1e-15));
        CHECK(unit.z == doctest::Approx(-6.0 / 7).epsilon(1e-15));
    }
    CHECK(length(Vec3{}) == 0);
    CHECK(length(direction(Vec3{})) == 0);
    Vec3 const a{1, -2, 3}, b{4, 5, -6}, normal = cross(a, b);
    CHECK(dot(normal, a) == 0);
    CHECK(dot(normal, b) == 0);
    for (Index axis = 0; axis < 3; ++axis) CHECK(unit_vector(axis)[axis] == 1);
}
