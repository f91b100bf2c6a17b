#include <harmorph_design.h>
#include <doctest/doctest.h>

#include "bspline/section.hpp"
#include <fixtures/curves.hpp>
#include <fixtures/traps.hpp>

#include <cmath>
#include <functional>
#include <string>

using fixtures::CurveSet;
using fixtures::pi;
using fixtures::quantity;
using fixtures::reversed;
using fixtures::Spline;

namespace {

hm_quantity thinnest(double first, double last, double sharpness) {
    hm_quantity out = quantity(HM_MIN_THICKNESS, first);
    out.last_station = last;
    out.sharpness = sharpness;
    return out;
}
hm_quantity sharpened(hm_quantity out, double sharpness) {
    out.sharpness = sharpness;
    return out;
}
hm_quantity clearance(std::vector<double> const& polygon) {
    hm_quantity out = quantity(HM_CLEARANCE);
    out.n_polygon = int(polygon.size() / 2);
    out.polygon = polygon.data();
    return out;
}

struct Result {
    hm_status status;
    double value = -777, at[2] = {};
    std::vector<double> gradient;
    hm_error error{};
};

Result measured(CurveSet& set, hm_quantity const& asked, hm_section const* section = nullptr) {
    Result out;
    out.gradient.assign(set.control.size(), -777);
    out.status = hm_measure(&set.view(), section, 1, &asked, &out.value, out.at,
                            out.gradient.data(), &out.error);
    return out;
}

double value_of(CurveSet& set, hm_quantity const& asked, hm_section const* section = nullptr) {
    Result const out = measured(set, asked, section);
    REQUIRE_MESSAGE(out.status == HM_OK, out.error.text);
    return out.value;
}

// Differences of fourth order along random directions agree with the derivatives.
void check_gradient(CurveSet& set, hm_quantity const& asked, hm_section const* section = nullptr,
                    double tolerance = 2e-8) {
    Result const exact = measured(set, asked, section);
    REQUIRE_MESSAGE(exact.status == HM_OK, exact.error.text);
    std::vector<double> const start = set.control;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double size = 0;
    for (double const g : exact.gradient) size = std::max(size, std::fabs(g));
    for (int trial = 0; trial < 4; ++trial) {
        std::vector<double> direction(start.size());
        double slope = 0;
        for (std::size_t k = 0; k < start.size(); ++k) {
            direction[k] = uniform(random);
            slope += exact.gradient[k] * direction[k];
        }
        auto const at = [&](double step) {
            for (std::size_t k = 0; k < start.size(); ++k)
                set.control[k] = start[k] + step * direction[k];
            return value_of(set, asked, section);
        };
        double const h = 1e-4,
                     by_steps = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
        INFO("kind " << asked.kind << ", derivatives of at most " << size);
        CHECK(std::fabs(by_steps - slope) <= tolerance * size);
    }
    set.control = start;
}

CurveSet circle(double radius, double cx, double cy) {
    return CurveSet(fixtures::exact_circle(radius, cx, cy));
}

// A cambered section of 13 points with a tied or an open trailing edge, from the trailing edge over
// the upper side.
CurveSet section(bool open, bool rational, int degree = 3) {
    std::vector<double> const x = {1, .92, .7, .45, .2, .04, -.005, .0, .1, .35, .6, .85, 1};
    std::vector<double> const y = {.004, .03,  .08,   .115, .11,   .06,  .012,
                                   -.03, -.06, -.055, -.04, -.015, -.006};
    Spline out;
    out.degree = degree;
    for (std::size_t k = 0; k < x.size(); ++k) {
        out.indices.push_back(int(k));
        if (!open && k == 12) {
            out.indices.back() = 0;
            continue;
        }
        out.control.push_back(x[k]);
        out.control.push_back(y[k]);
        if (rational) out.weights.push_back(0.7 + 0.13 * double(k % 6));
    }
    out.knots = fixtures::clamped_knots(degree, 13);
    return CurveSet(out);
}

// Derivatives of the two directions: of first order in the step, so that corners are not crossed.
struct BothDirections {
    double left, right;
};
BothDirections slopes(CurveSet set, hm_quantity const& asked, std::size_t k) {
    double const h = 1e-6, here = value_of(set, asked), start = set.control[k];
    set.control[k] = start + h;
    double const above = value_of(set, asked);
    set.control[k] = start - h;
    double const below = value_of(set, asked);
    return {(here - below) / h, (above - here) / h};
}

}  // namespace

TEST_CASE("the measures of a circle are those of the formulas") {
    double const r = 0.7, cx = 3, cy = -2;
    CurveSet set = circle(r, cx, cy);
    hm_section const chord = fixtures::chord(cx - r, cy, cx + r, cy);
    auto const check_value = [&](int kind, double value) {
        CHECK(value_of(set, quantity(kind), &chord) == doctest::Approx(value).epsilon(1e-13));
    };
    check_value(HM_AREA, pi * r * r);
    check_value(HM_CENTROID_X, cx);
    check_value(HM_CENTROID_Y, cy);
    check_value(HM_MOMENT_XX, pi * std::pow(r, 4) / 4);
    check_value(HM_MOMENT_YY, pi * std::pow(r, 4) / 4);
    CHECK(std::fabs(value_of(set, quantity(HM_MOMENT_XY), &chord)) < 1e-14);
    check_value(HM_CHORD, 2 * r);
    check_value(HM_MAX_THICKNESS, 2 * r);
    check_value(HM_LEADING_EDGE_RADIUS, r);
    check_value(HM_MIN_RADIUS, r);
    for (double const station : {0.1, 0.37, 0.9}) {
        double const x = (2 * station - 1) * r;
        CHECK(value_of(set, quantity(HM_THICKNESS, station), &chord) ==
              doctest::Approx(2 * std::sqrt(r * r - x * x)).epsilon(1e-13));
        CHECK(std::fabs(value_of(set, quantity(HM_CAMBER, station), &chord)) < 1e-14);
    }
    CHECK(std::fabs(value_of(set, quantity(HM_CURVATURE_VARIATION), &chord)) < 1e-12);
    // A square of half side .3, then one that sticks out; a segment; a point.
    auto const box = [&](double h) {
        return std::vector<double>{cx - h, cy - h, cx + h, cy - h, cx + h, cy + h, cx - h, cy + h};
    };
    auto const distance = [&](std::vector<double> const& polygon) {
        return value_of(set, clearance(polygon));
    };
    CHECK(distance(box(0.3)) == doctest::Approx(r - 0.3 * std::sqrt(2.0)).epsilon(1e-12));
    CHECK(distance(box(0.6)) == doctest::Approx(r - 0.6 * std::sqrt(2.0)).epsilon(1e-12));
    CHECK(distance({cx, cy, cx + 0.2, cy}) == doctest::Approx(r - 0.2).epsilon(1e-12));
    // Repeated points, as in a polygon that ends with its first point, raise no exception.
    std::vector<double> repeated = box(0.3);
    repeated.insert(repeated.end(), {repeated[6], repeated[7], repeated[0], repeated[1]});
    CHECK(distance(repeated) == distance(box(0.3)));
    CHECK(distance({cx + 2, cy}) == doctest::Approx(r - 2).epsilon(1e-12));
}

TEST_CASE("areas of polygons and clearances to their sides are right") {
    Spline square;
    square.degree = 1;
    square.control = {0, 0, 4, 0, 4, 2, 0, 2};
    square.indices = {0, 1, 2, 3, 0};
    square.knots = {0, 0, 1, 2, 3, 4, 4};
    CurveSet set(square);
    CHECK(value_of(set, quantity(HM_AREA)) == doctest::Approx(8).epsilon(1e-14));
    CHECK(value_of(set, quantity(HM_MOMENT_XX)) == doctest::Approx(4 * 8 / 12.0).epsilon(1e-14));
    CHECK(value_of(set, quantity(HM_MOMENT_YY)) == doctest::Approx(2 * 64 / 12.0).epsilon(1e-14));
    CHECK(value_of(set, clearance({1, 0.5, 3, 0.5, 2, 1.9})) ==
          doctest::Approx(0.1).epsilon(1e-12));
    // The outline bends in between two corners of the polygon: a notch down to (2, 1).
    Spline notched = square;
    notched.control = {0, 0, 4, 0, 4, 2, 2, 1, 0, 2};
    notched.indices = {0, 1, 2, 3, 4, 0};
    notched.knots = {0, 0, 1, 2, 3, 4, 5, 5};
    CurveSet notch(notched);
    CHECK(value_of(notch, clearance({1, 0.75, 3, 0.75})) == doctest::Approx(0.25).epsilon(1e-12));
    CHECK(value_of(notch, clearance({1, 1.25, 3, 1.25})) < -0.1);
}

TEST_CASE(
    "the clearance of a side is the smallest one of its points, also where a bend is nearest") {
    Spline dented;
    dented.degree = 3;
    dented.control = {0, 0, 2, -0.2, 4, 0, 4, 2, 3, 2, 2.1, 0.7, 1, 2, 0, 2};
    dented.indices = {0, 1, 2, 3, 4, 5, 6, 7, 0};
    dented.knots = fixtures::clamped_knots(3, 9);
    CurveSet set(dented);
    double const ax = 0.8, ay = 0.72, bx = 3.1, by = 0.78;
    double smallest = 1;
    for (int k = 0; k <= 2000; ++k) {
        double const t = k / 2000.0;
        smallest =
            std::min(smallest, value_of(set, clearance({ax + t * (bx - ax), ay + t * (by - ay)})));
    }
    double const of_side = value_of(set, clearance({ax, ay, bx, by}));
    CHECK(smallest < 0.9 * value_of(set, clearance({ax, ay})));
    CHECK(smallest < 0.9 * value_of(set, clearance({bx, by})));
    CHECK(of_side <= smallest);
    CHECK(of_side == doctest::Approx(smallest).epsilon(1e-5));
}

TEST_CASE("the smallest radius is found on either side of a knot where the curvature jumps") {
    for (bool const open : {false, true}) {
        CurveSet const forwards = section(open, false, 2);
        for (CurveSet set : {forwards, reversed(forwards)}) {
            hm_curve const& curve = set.view().curve[0];
            double sharpest = 0;
            for (int span = 2; span < curve.n_indices; ++span)
                for (int k = 0; k <= 1000; ++k) {
                    double const t = std::min(std::max(k / 1000.0, 1e-9), 1 - 1e-9),
                                 low = curve.knots[span], high = curve.knots[span + 1];
                    double c[6];
                    REQUIRE(hm_curve_point(&set.view(), 0, low + t * (high - low), 2, c, nullptr) ==
                            HM_OK);
                    sharpest = std::max(sharpest, std::fabs(c[2] * c[5] - c[3] * c[4]) /
                                                      std::pow(std::hypot(c[2], c[3]), 3));
                }
            double const radius = value_of(set, quantity(HM_MIN_RADIUS));
            CHECK(radius <= 1 / sharpest * (1 + 1e-6));
            CHECK(radius == doctest::Approx(1 / sharpest).epsilon(1e-3));
        }
    }
}

TEST_CASE("a section of two curves may have gaps of 1e-9 of the extent, and its base is a side") {
    for (bool const upright : {false, true})
        for (double const gap : {0.0, 5e-10, 2e-9}) {
            Spline upper, lower;
            upper.degree = lower.degree = 1;
            upper.control = {1, 0.05, 0, 0.05, 0, 0};
            lower.control = {0, -gap, 1, 0};
            upper.knots = {0, 0, 0.5, 1, 1};
            lower.knots = {0, 0, 1, 1};
            CurveSet set(upper);
            set.add(lower);
            if (upright)
                for (std::size_t k = 0; k < set.control.size(); k += 2)
                    std::swap(set.control[k], set.control[k + 1] *= -1);
            Result const area = measured(set, quantity(HM_AREA));
            CHECK(area.status == (gap < 1e-9 ? HM_OK : HM_BAD_CURVE));
            if (area.status == HM_OK) CHECK(area.value == doctest::Approx(0.05).epsilon(1e-7));
            if (gap > 0) continue;
            // Nearest to this point is the base, where the outline is closed.
            std::vector<double> const inside =
                upright ? std::vector<double>{-0.03, 0.99} : std::vector<double>{0.99, 0.03};
            Result const free = measured(set, clearance(inside));
            CHECK(free.status == HM_OK);
            CHECK(free.value == doctest::Approx(0.01));
            CHECK(free.at[0] == doctest::Approx(upright ? -0.03 : 1));
            CHECK(free.at[1] == doctest::Approx(upright ? 1 : 0.03));
        }
}

TEST_CASE("derivatives of all quantities agree with differences for sections of all kinds") {
    std::vector<double> const box = {0.2, -0.03, 0.6, -0.02, 0.6, 0.05, 0.2, 0.06},
                              wide = {0.1, -0.2, 0.8, 0.0, 0.3, 0.3};
    for (bool const rational : {false, true})
        for (int kind = 0; kind < 3; ++kind)
            for (bool const fixed : {rational, !rational}) {
                if (fixed == rational && kind != 1) continue;
                CurveSet set =
                    kind == 2 ? reversed(section(true, rational)) : section(kind == 1, rational);
                if (kind == 1) set.add_over(1, {12, 0}, {0, 0, 1, 1});
                hm_section const chord =
                    fixtures::chord(0, 0, fixed ? 0.999 : 0, fixed ? -0.001 : 0);
                INFO("rational " << rational << ", kind " << kind << ", fixed chord " << fixed);
                for (int k = HM_AREA; k <= HM_CURVATURE_VARIATION; ++k) {
                    if (k == HM_THICKNESS || k == HM_CAMBER) continue;
                    bool const zero =
                        (k == HM_CHORD && fixed) || (k == HM_TRAILING_EDGE_GAP && kind == 0);
                    if (zero) continue;
                    check_gradient(set, quantity(k), &chord,
                                   k == HM_CURVATURE_VARIATION || k == HM_MIN_RADIUS ? 1e-4 : 2e-7);
                }
                for (double const station : {0.03, 0.25, 0.6, 0.93}) {
                    check_gradient(set, quantity(HM_THICKNESS, station), &chord, 2e-7);
                    check_gradient(set, quantity(HM_CAMBER, station), &chord, 2e-7);
                }
                for (double const sharpness : {0.0, 30.0, 500.0}) {
                    check_gradient(set, thinnest(0.05, 0.3, sharpness), &chord, 1e-6);
                    check_gradient(set, thinnest(0.15, 0.9, sharpness), &chord, 1e-6);
                }
                if (!fixed) check_gradient(set, quantity(HM_TWIST), &chord, 1e-7);
                check_gradient(set, sharpened(clearance(box), 40), &chord, 1e-6);
                check_gradient(set, clearance(box), &chord, 1e-6);
                check_gradient(set, clearance(wide), &chord, 1e-6);
            }
}

TEST_CASE("measures of a section do not depend on direction, and follow rotation and scale") {
    for (bool const open : {false, true}) {
        CurveSet set = section(open, true), back = reversed(section(open, true)),
                 moved = section(open, true);
        double const angle = 0.4, scale = 3, c = scale * std::cos(angle),
                     s = scale * std::sin(angle);
        for (std::size_t k = 0; k < moved.control.size(); k += 2) {
            double const x = moved.control[k], y = moved.control[k + 1];
            moved.control[k] = 5 + c * x - s * y;
            moved.control[k + 1] = -7 + s * x + c * y;
        }
        auto const check = [&](int kind, double power, double station = 0) {
            double const value = value_of(set, quantity(kind, station));
            INFO("kind " << kind);
            CHECK(value_of(back, quantity(kind, station)) == doctest::Approx(value).epsilon(1e-11));
            CHECK(value_of(moved, quantity(kind, station)) ==
                  doctest::Approx(std::pow(scale, power) * value).epsilon(1e-10));
        };
        check(HM_AREA, 2);
        check(HM_CHORD, 1);
        CHECK(value_of(moved, quantity(HM_TWIST)) - value_of(set, quantity(HM_TWIST)) ==
              doctest::Approx(angle * 180 / pi).epsilon(1e-10));
        for (double const sharpness : {0.0, 60.0})
            CHECK(value_of(moved, thinnest(0.1, 0.8, sharpness / scale)) ==
                  doctest::Approx(scale * value_of(set, thinnest(0.1, 0.8, sharpness)))
                      .epsilon(1e-10));
        check(HM_THICKNESS, 1, 0.3);
        check(HM_CAMBER, 1, 0.3);
        check(HM_MAX_THICKNESS, 1);
        check(HM_MAX_CAMBER, 1);
        check(HM_LEADING_EDGE_RADIUS, 1);
        check(HM_TRAILING_EDGE_ANGLE, 0);
        check(HM_MIN_RADIUS, 1);
        check(HM_CURVATURE_VARIATION, -3);
        if (open) check(HM_TRAILING_EDGE_GAP, 1);
        CHECK(value_of(set, quantity(HM_TRAILING_EDGE_GAP)) > (open ? 0.009 : -1e-16));
        CHECK(value_of(set, quantity(HM_TRAILING_EDGE_ANGLE)) > 5);
    }
}

TEST_CASE("the maximum over stations is at least the value of any station, and is one of them") {
    CurveSet set = section(true, false);
    Result const thickest = measured(set, quantity(HM_MAX_THICKNESS)),
                 cambered = measured(set, quantity(HM_MAX_CAMBER));
    for (int k = 1; k < 200; ++k) {
        CHECK(value_of(set, quantity(HM_THICKNESS, k / 200.0)) <= thickest.value);
        CHECK(std::fabs(value_of(set, quantity(HM_CAMBER, k / 200.0))) <=
              std::fabs(cambered.value));
    }
    CHECK(thickest.at[0] > 0.1);
    CHECK(thickest.at[0] < 0.6);
}

TEST_CASE("the smallest thickness is no larger than any station, and the smooth bound is below") {
    CurveSet set = section(true, false);
    for (double const first : {0.05, 0.3, 0.6}) {
        for (double const last : {first, 0.75, 0.9}) {
            Result const exact = measured(set, thinnest(first, last, 0));
            double least = HUGE_VAL;
            for (int k = 0; k <= 200; ++k) {
                double const station = first + (last - first) * k / 200;
                least = std::fmin(least, value_of(set, quantity(HM_THICKNESS, station)));
            }
            CHECK(exact.value <= least * (1 + 1e-12));
            CHECK(exact.value >= least - 1e-4);
            for (double const sharpness : {10.0, 1000.0, 1e5}) {
                double const smooth = value_of(set, thinnest(first, last, sharpness));
                CHECK(smooth <= least * (1 + 1e-12));
                CHECK(smooth >= exact.value - std::log(65.0) / sharpness * (1 + 1e-9));
            }
        }
    }
    // An hourglass is thinnest in its middle.
    Spline waist;
    waist.degree = 2;
    waist.control = {4, 0, 4, 1, 2, 0.2, 0, 1, 0, 0, 0, -1, 2, -0.2, 4, -1};
    for (int k = 0; k < 9; ++k) waist.indices.push_back(k % 8);
    waist.knots = fixtures::clamped_knots(2, 9);
    CurveSet hourglass(waist);
    hm_section const chord = fixtures::chord(0, 0, 4, 0);
    Result const middle = measured(hourglass, thinnest(0.2, 0.8, 0), &chord);
    REQUIRE(middle.status == HM_OK);
    CHECK(middle.at[0] == doctest::Approx(2).epsilon(1e-6));
    CHECK(middle.value ==
          doctest::Approx(value_of(hourglass, quantity(HM_THICKNESS, 0.5), &chord)).epsilon(1e-12));
    check_gradient(hourglass, thinnest(0.2, 0.8, 0), &chord, 1e-6);
}

TEST_CASE("the smooth clearance is below that of the points of the polygon") {
    CurveSet set = circle(2, 1, 1);
    std::vector<double> const box = {0, 0.2, 2.1, 0, 1.8, 2, 0.3, 1.9};
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < box.size(); k += 2)
        least = std::fmin(least, 2 - std::hypot(box[k] - 1, box[k + 1] - 1));
    for (double const sharpness : {5.0, 100.0, 1e4}) {
        double const smooth = value_of(set, sharpened(clearance(box), sharpness));
        CHECK(smooth <= least);
        CHECK(smooth >= least - std::log(4.0) / sharpness * (1 + 1e-9));
    }
}

TEST_CASE("a smooth closed outline has the edge angle 180 and its exact derivative") {
    for (bool const back : {false, true})
        for (int turn = 0; turn < 40; ++turn) {
            Spline const ellipse = fixtures::ring(3 + turn % 2, 9, 1, 0.4, 3, -2, 0.17 * turn);
            CurveSet set(ellipse);
            if (back) set = reversed(set);
            CHECK(value_of(set, quantity(HM_TRAILING_EDGE_ANGLE)) ==
                  doctest::Approx(180).epsilon(1e-12));
            check_gradient(set, quantity(HM_TRAILING_EDGE_ANGLE));
        }
}

TEST_CASE("edge angles are continuous from a thin edge to a notch, and negative for crossed ends") {
    for (double angle = -80; angle < 265; angle += 7.25) {
        double const half = angle * pi / 360, c = std::cos(half), s = std::sin(half);
        Spline kite;  // its edge is at the origin, its body at the left
        kite.degree = 1;
        kite.control = {0, 0, -c, s, -6, 4, -6, -4, -c, -s};
        kite.indices = {0, 1, 2, 3, 4, 0};
        kite.knots = {0, 0, 1, 2, 3, 4, 5, 5};
        CurveSet set(kite), back = reversed(CurveSet(kite));
        CHECK(value_of(set, quantity(HM_TRAILING_EDGE_ANGLE)) ==
              doctest::Approx(angle).epsilon(1e-12));
        CHECK(value_of(back, quantity(HM_TRAILING_EDGE_ANGLE)) ==
              doctest::Approx(angle).epsilon(1e-12));
    }
}

TEST_CASE("the derivative of an extreme at a corner follows the corner") {
    struct Outline {
        const char* what;
        int degree;
        std::vector<double> control, knots;
        bool is_smooth;  // the extreme, as a function of the control points
    };
    Outline const all[] = {
        {"a corner above", 1, {1, 0, .45, .1, 0, 0, .62, -.07}, {0, 0, 1, 2, 3, 4, 4}, true},
        {"a corner below", 1, {1, 0, .62, .07, 0, 0, .45, -.1}, {0, 0, 1, 2, 3, 4, 4}, true},
        {"both corners at one station",
         1,
         {1, 0, .45, .1, 0, 0, .45, -.07},
         {0, 0, 1, 2, 3, 4, 4},
         false},
        {"a corner that a sample hits",
         1,
         {1, 0, .5, .1, 0, 0, .7, -.07},
         {0, 0, 1, 2, 3, 4, 4},
         true},
        {"a cubic with a corner above",
         3,
         {1, 0, .9, .06, .7, .1, .5, .14, .3, .11, .1, .07, 0, 0, .1, -.05, .5, -.06, .9, -.02},
         {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 4, 4, 4, 4},
         true},
        {"a smooth cubic",
         3,
         {1, 0, .9, .06, .7, .1, .5, .14, .3, .11, .1, .07, 0, 0, .1, -.05, .5, -.06, .9, -.02},
         {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8},
         true},
    };
    for (Outline const& outline : all) {
        Spline spline;
        spline.degree = outline.degree;
        spline.control = outline.control;
        spline.knots = outline.knots;
        int const n = int(outline.control.size() / 2);
        for (int k = 0; k <= n; ++k) spline.indices.push_back(k % n);
        for (bool const back : {false, true}) {
            CurveSet const set = back ? reversed(CurveSet(spline)) : CurveSet(spline);
            for (int const kind : {HM_MAX_THICKNESS, HM_MAX_CAMBER}) {
                CurveSet own = set;
                Result const found = measured(own, quantity(kind));
                REQUIRE_MESSAGE(found.status == HM_OK, found.error.text);
                for (std::size_t k = 0; k < set.control.size(); ++k) {
                    BothDirections const by = slopes(set, quantity(kind), k);
                    INFO(outline.what << ", back " << back << ", kind " << kind << ", number " << k
                                      << ": " << found.gradient[k] << " of " << by.left << " to "
                                      << by.right);
                    CHECK(found.gradient[k] >= std::min(by.left, by.right) - 2e-5);
                    CHECK(found.gradient[k] <= std::max(by.left, by.right) + 2e-5);
                    if (outline.is_smooth) CHECK(std::fabs(by.left - by.right) < 2e-5);
                }
            }
        }
    }
}

TEST_CASE("quantities that cannot be measured are refused with the reason, and outputs stay") {
    CurveSet set = section(false, false), ring(fixtures::ring(3, 9, 1, 0.4)),
             line(fixtures::clamped(1, 2, 1));
    auto const refusal = [&](CurveSet& curves, hm_quantity const& asked, std::string const& word,
                             hm_section const* with = nullptr) {
        Result const out = measured(curves, asked, with);
        CHECK_MESSAGE(std::string(out.error.text).find(word) != std::string::npos, out.error.text);
        CHECK(out.value == -777);
        CHECK(out.gradient[0] == -777);
        return out.status;
    };
    CHECK(refusal(ring, quantity(HM_CHORD), "trailing edge") == HM_BAD_CURVE);
    CHECK(refusal(line, quantity(HM_AREA), "no area") == HM_BAD_CURVE);
    CHECK(refusal(line, quantity(HM_MIN_RADIUS), "straight") == HM_BAD_CURVE);
    Spline cusp;  // in the middle
    cusp.control = {0, 0, 1, 1, 0, 1, 1, 0};
    cusp.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    CurveSet still(cusp);
    for (int const kind : {HM_MIN_RADIUS, HM_CURVATURE_VARIATION})
        CHECK(refusal(still, quantity(kind), "has no curvature at parameter 5.00000e-1") ==
              HM_BAD_CURVE);
    hm_section const outside = fixtures::chord(10, 0, 11, 0);
    CHECK(refusal(set, quantity(HM_THICKNESS, 0.5), "fewer than two", &outside) == HM_BAD_CURVE);
    CurveSet apart = section(true, false);
    apart.add(fixtures::clamped(2, 4, 3));
    CHECK(refusal(apart, quantity(HM_AREA), "curve 1") == HM_BAD_CURVE);
}

TEST_CASE("a change of sign lies between neighbouring numbers, and few values find it") {
    struct {
        double (*function)(double);
        int max_values;
    } const cases[] = {{[](double u) { return u - 0.3; }, 30},
                       {[](double u) { return 0.123 - u * u * u; }, 40},
                       {[](double u) { return std::pow(u - 0.7, 9); }, 200},     // flat
                       {[](double u) { return u < 1e-9 ? -1.0 : 1e-12; }, 200},  // a jump
                       {[](double u) { return std::floor((u - 0.4) * 1e12) + 0.5; }, 200},  // steps
                       {[](double) { return 0.0; }, 200}};
    for (auto const& one : cases) {
        int values = 0;
        harmorph::Neighbours const found = harmorph::sign_change_between(0.0, 1.0, [&](double u) {
            ++values;
            return one.function(u);
        });
        CAPTURE(found.low);
        CHECK(values <= one.max_values);
        CHECK(found.high == std::nextafter(found.low, 2.0));
        bool const changes = (one.function(found.low) < 0) != (one.function(found.high) < 0);
        CHECK((changes || one.function(0) == one.function(1)));
    }
}
