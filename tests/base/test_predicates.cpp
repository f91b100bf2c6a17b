// Signs of determinants: against whole numbers where they fit, and against geometry where nothing
// fits.
#include <doctest/doctest.h>

#include <fixtures/perturb.hpp>
#include <fixtures/wrong.hpp>

#include "base/predicates.hpp"

using harmorph::in_circle_sign;
using harmorph::orientation_sign;
using harmorph::Vec2;

namespace {

struct GridPoint {
    std::int64_t x, y;
};
GridPoint operator-(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y}; }
std::int64_t cross(GridPoint a, GridPoint b) { return a.x * b.y - a.y * b.x; }
std::int64_t square(GridPoint a) { return a.x * a.x + a.y * a.y; }

// Sums of products of two numbers below 2^62: high 2^62 + middle 2^31 + low, as not all processors
// have 128 bits.
class Whole {
public:
    void add_product(std::int64_t a, std::int64_t b) {
        add(0, 0, (a & below_2_31) * (b & below_2_31));
        add(0, (a >> 31) * (b & below_2_31), 0);
        add(0, (a & below_2_31) * (b >> 31), 0);
        add((a >> 31) * (b >> 31), 0, 0);
    }
    int sign() const { return high_ < 0 ? -1 : high_ + middle_ + low_ > 0; }

private:
    static constexpr std::int64_t below_2_31 = (std::int64_t{1} << 31) - 1;

    void add(std::int64_t high, std::int64_t middle, std::int64_t low) {
        low_ += low;
        middle_ += middle + (low_ >> 31);
        high_ += high + (middle_ >> 31);
        low_ &= below_2_31;
        middle_ &= below_2_31;
    }
    std::int64_t high_ = 0, middle_ = 0, low_ = 0;
};

int orientation_sign(GridPoint a, GridPoint b, GridPoint c) {
    std::int64_t const area = cross(a - c, b - c);
    return area < 0 ? -1 : area > 0;
}
int in_circle_sign(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {  // differences below 2^30
    GridPoint const p = a - d, q = b - d, r = c - d;
    Whole sum;
    sum.add_product(square(p), cross(q, r));
    sum.add_product(square(q), cross(r, p));
    sum.add_product(square(r), cross(p, q));
    return sum.sign();
}

Vec2 at(GridPoint p, double scale) { return {scale * double(p.x), scale * double(p.y)}; }

std::int64_t below(std::mt19937& random, std::int64_t end) {
    return std::int64_t(fixtures::uniform(random) * double(end));
}

// Any exponent a double can have, subnormals included, either sign, 0 now and then.
double any_number(std::mt19937& random) {
    if (random() % 8 == 0) return 0;
    double const mantissa = 1 + fixtures::uniform(random);
    double const size = std::ldexp(mantissa, int(random() % 2090) - 1067);
    return random() % 2 == 0 ? size : -size;
}

}  // namespace

TEST_CASE("signs are those of integer arithmetic, in any unit of length") {
    std::mt19937 random(1);
    int degenerate = 0;
    fixtures::Wrong wrong;  // signs, in which round
    for (int round = 0; round < 20000; ++round) {
        // Few points on a line or a circle by chance: small numbers, and a fourth point mirrored or
        // one step off.
        std::int64_t const size = round % 2 == 0 ? 8 : 20000, far = round % 3 == 0 ? 1 << 28 : 0;
        GridPoint p[4];
        for (GridPoint& one : p) one = {far + below(random, size), far + below(random, size)};
        if (round % 5 == 0) p[3] = {p[0].x + p[1].x - p[2].x, p[0].y + p[1].y - p[2].y};
        if (round % 7 == 0) p[2] = {2 * p[1].x - p[0].x, 2 * p[1].y - p[0].y};
        int const turn = orientation_sign(p[0], p[1], p[2]),
                  circle = in_circle_sign(p[0], p[1], p[2], p[3]);
        degenerate += (turn == 0 || circle == 0) ? 1 : 0;
        for (double const scale : {1.0, 0x1p-900, 0x1p900, 0x1p-1074, 0x1p994, 0x1p-300, 3.0}) {
            Vec2 q[4];
            for (int k = 0; k < 4; ++k)
                q[k] = at(p[k], scale);  // 3 times a number below 2^30 is exact as well
            wrong.compare(round, orientation_sign(q[0], q[1], q[2]), turn);
            wrong.compare(round, in_circle_sign(q[0], q[1], q[2], q[3]), circle);
        }
    }
    CHECK(wrong == 0);
    CHECK(degenerate > 2000);
}

TEST_CASE("orientation is exact where no double can hold the products") {
    // (k, k) for neighbouring doubles k lie on one line; a step of one unit beside it decides.
    double const a = 0.1, b = std::nextafter(a, 1), c = std::nextafter(b, 1);
    CHECK(orientation_sign(Vec2{a, a}, Vec2{b, b}, Vec2{c, c}) == 0);
    CHECK(orientation_sign(Vec2{a, a}, Vec2{b, b}, Vec2{c, std::nextafter(c, 1)}) == 1);
    CHECK(orientation_sign(Vec2{a, a}, Vec2{1e300, 1e300}, Vec2{b, b}) == 0);
    CHECK(orientation_sign(Vec2{a, a}, Vec2{1e300, 1e300}, Vec2{b, c}) == 1);
    CHECK(orientation_sign(Vec2{0, 0}, Vec2{1e300, 0}, Vec2{-1e300, 5e-324}) == 1);
    CHECK(orientation_sign(Vec2{0, 0}, Vec2{1e300, 0}, Vec2{-1e300, -5e-324}) == -1);
    double const most = 1.7976931348623157e308;
    CHECK(orientation_sign(Vec2{-most, -most}, Vec2{most, -most}, Vec2{most, most}) == 1);
}

TEST_CASE("the in-circle sign is exact for a point next to the circle, at any scale") {
    double const tiny = 5e-324;
    for (double const r : {1e300, 1.0, 1e-300}) {
        Vec2 const a{r, 0}, b{0, r}, c{-r, 0};
        CHECK(in_circle_sign(a, b, c, Vec2{0, -r}) == 0);
        CHECK(in_circle_sign(a, b, c, Vec2{0, -std::nextafter(r, 0)}) == 1);
        CHECK(in_circle_sign(a, b, c, Vec2{0, -std::nextafter(r, 2 * r)}) == -1);
        CHECK(in_circle_sign(a, b, c, Vec2{tiny, -r}) == -1);
        CHECK(in_circle_sign(a, b, c, Vec2{tiny, 0}) == 1);
        // Through (r, h), (0, r), (-r, 0) the centre is (t, -t), t = h^2 / (4 r - 2 h): a larger
        // circle for either sign of h.
        CHECK(in_circle_sign(Vec2{r, tiny}, b, c, Vec2{0, -r}) == 1);
        CHECK(in_circle_sign(Vec2{r, -tiny}, b, c, Vec2{0, -r}) == 1);
    }
}

TEST_CASE("swapping two points changes the sign, whatever their coordinates") {
    std::mt19937 random(2);
    int not_zero = 0;
    fixtures::Wrong wrong;  // signs, in which round
    for (int round = 0; round < 3000; ++round) {
        Vec2 p[4];
        for (Vec2& one : p) one = {any_number(random), any_number(random)};
        int const turn = orientation_sign(p[0], p[1], p[2]);
        wrong.compare(round, orientation_sign(p[1], p[0], p[2]), -turn);
        wrong.compare(round, orientation_sign(p[1], p[2], p[0]), turn);
        int const circle = in_circle_sign(p[0], p[1], p[2], p[3]);
        not_zero += circle != 0;
        wrong.compare(round, in_circle_sign(p[1], p[0], p[2], p[3]), -circle);
        wrong.compare(round, in_circle_sign(p[0], p[1], p[3], p[2]), -circle);
        wrong.compare(round, in_circle_sign(p[1], p[2], p[3], p[0]), -circle);
        wrong.compare(round, in_circle_sign(p[0], p[1], p[2], p[0]), 0);
        // x and y change places: a reflection.
        Vec2 const m[] = {{p[0].y, p[0].x}, {p[1].y, p[1].x}, {p[2].y, p[2].x}, {p[3].y, p[3].x}};
        wrong.compare(round, in_circle_sign(m[0], m[1], m[2], m[3]), -circle);
    }
    CHECK(wrong == 0);
    CHECK(not_zero > 1500);
}
