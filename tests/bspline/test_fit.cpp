#include <doctest/doctest.h>

#include "bspline/projection.hpp"

#include <fixtures/section_families.hpp>
#include <fixtures/spline.hpp>

#include <algorithm>
#include <limits>
#include <string>

using namespace harmorph;
using fixtures::FitRun;
using fixtures::naca;

namespace {

double max_error(std::vector<Vec2> const& points, FitOptions const& options = {},
                 bool is_loop = true) {
    FitRun const run(points, options, is_loop);
    REQUIRE_MESSAGE(!failed(run.status), run.fault.sentence);
    Fault fault;
    for (Index c = 0; c < run.fit.n_curves; ++c)
        CHECK(check_curve(run.fit.curve[c], c, fault) == Status::ok);
    return run.report.max_error;
}

FitOptions options(Index degree, Index n_control, Closure closure = Closure::automatic) {
    return {degree, n_control, closure};
}

// Largest distance between the control points of two fits, those of the second listed backwards
// where `reversed`.
double difference(FitRun const& a, FitRun const& b, int n, int shift, bool reversed) {
    double out = 0;
    for (int i = 0; i < n; ++i)
        out = std::fmax(out, length(a.control(i) - b.control(reversed ? (n - i + shift) % n : i)));
    return out;
}

std::vector<Vec2> sampled(fixtures::Spline const& spline, int n, bool with_end) {
    Curve const curve = spline.curve();
    std::vector<Vec2> out;
    for (int k = 0; k < n; ++k)
        out.push_back(curve_point(
            curve, curve.begin() + (curve.end() - curve.begin()) * k / (with_end ? n - 1.0 : n)));
    return out;
}

void refused(std::vector<Vec2> const& points, FitOptions const& wish, bool is_loop,
             std::string const& word, Index item) {
    FitRun const run(points, wish, is_loop);
    CHECK(run.status == Status::bad_curve);
    CHECK_MESSAGE(std::string(run.fault.sentence).find(word) != std::string::npos,
                  run.fault.sentence);
    if (item == none) CHECK(run.fault.item.kind == harmorph::ItemKind::nothing);
    else CHECK(run.fault.item.number == item);
}

}  // namespace

TEST_CASE("airfoils of all kinds are fitted with 20 control points") {
    for (int const n : {15, 20, 50, 100, 1000})
        for (double const clustering : {0.8, 1.0})
            for (double const camber : {0.0, 0.04}) {
                // With few points, the curve also stays near the polygon of the points.
                double const bound = n <= 20 ? 2e-4 : 1e-4;
                CHECK(max_error(naca({camber, 0.4, 0.12, false}, n, clustering)) < bound);
                CHECK(max_error(naca({camber, 0.4, 0.12, true}, n, clustering)) < bound);
                CHECK(max_error(naca({camber, 0.3, 0.06, true}, n, clustering, 1)) < 2e-4);
            }
    CHECK(max_error(naca({0, 0.4, 0.12, false}, 2500)) < 3e-5);
    for (double const radius : {5e-4, 2e-3, 5e-3})
        CHECK(max_error(fixtures::rounded_edge(100, radius, 12)) < 2e-4);
    CHECK(max_error(fixtures::vectors(fixtures::joukowski(0.1, 0.05, 60))) < 1e-4);
    CHECK(max_error(fixtures::ellipse(100, 1)) < 1e-5);
    CHECK(max_error(fixtures::rounded_to(naca({0.02, 0.4, 0.12, true}, 1000), 6)) < 1e-4);
}

TEST_CASE("the report of a fit agrees with the fitted curve") {
    std::vector<Vec2> const points = naca({0.02, 0.4, 0.12, true}, 60, 0.8, 5);
    FitRun const run(points, {});
    REQUIRE(run.status == Status::ok);
    CHECK(run.report.closure == Closure::open);
    CHECK(run.report.first_point == 5);
    CHECK(run.report.base_points == 6);
    REQUIRE(run.fit.n_curves == 2);
    Curve const& wing = run.fit.curve[0];
    Curve const& base = run.fit.curve[1];
    CHECK(base.degree == 1);
    CHECK(base.n_indices == 2);
    CHECK(base.control_point(0) == wing.control_point(wing.n_indices - 1));
    CHECK(base.control_point(1) == wing.control_point(0));
    CHECK(wing.begin() == 0);
    CHECK(wing.end() == 1);
    CHECK(curve_point(wing, 0).x == points[5].x);
    CHECK(curve_point(wing, 0).y == points[5].y);
    CHECK(curve_point(wing, 1).x == points[0].x);
    CHECK(curve_point(wing, 1).y == points[0].y);
    double largest = 0, sum = 0;
    for (Vec2 const p : points) {
        double const distance = std::fmin(project(wing, p).distance, project(base, p).distance);
        largest = std::fmax(largest, distance);
        sum += distance * distance;
    }
    CHECK(run.report.max_error == largest);
    CHECK(run.report.rms_error == doctest::Approx(std::sqrt(sum / double(points.size()))));
    CHECK(std::fmin(project(wing, points[std::size_t(run.report.max_error_point)]).distance, 1) ==
          largest);
}

TEST_CASE("a tied curve closes in one control point, a periodic one in as many as its degree") {
    for (Index degree = 1; degree <= 5; ++degree) {
        std::vector<Vec2> const points = naca({}, 60);
        FitRun const tied(points, options(degree, 16));
        REQUIRE(tied.status == Status::ok);
        Curve const& sharp = tied.fit.curve[0];
        CHECK(tied.report.closure == Closure::tied);
        CHECK(sharp.n_indices == 17);
        CHECK(sharp.control_point(16) == 0);
        CHECK(tied.control(0).x == points[0].x);
        CHECK(tied.control(0).y == points[0].y);
        FitRun const smooth(points, options(degree, 16, Closure::periodic));
        REQUIRE(!failed(smooth.status));  // it may run back where the edge is sharp
        Curve const& ring = smooth.fit.curve[0];
        CHECK(ring.n_indices == 16 + degree);
        for (Index k = 0; k < degree; ++k) CHECK(ring.control_point(16 + k) == k);
        if (degree > 1) CHECK(is_periodic(ring));
    }
}

TEST_CASE("corners are kept, so that polygons are reproduced") {
    for (Index degree = 1; degree <= 5; ++degree) {
        CHECK(max_error(fixtures::polygon({{1, 0}, {0.5, 0.05}, {0, 0}, {0.5, -0.05}}, 20),
                        options(degree, 24)) < 1e-13);
        CHECK(max_error(fixtures::polygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 15),
                        options(degree, 22)) < 1e-12);
    }
    std::vector<Vec2> bend;
    for (int k = 0; k <= 40; ++k) bend.push_back({k < 20 ? k : 20.0, k < 20 ? 0 : k - 20.0});
    CHECK(max_error(bend, options(3, 12), false) < 1e-11);
}

TEST_CASE("straight lines are reproduced to rounding") {
    for (Index degree = 1; degree <= 5; ++degree)
        for (Index const n_control : {degree + 1, degree + 4, 20}) {
            std::vector<Vec2> line;
            for (int k = 0; k < 30; ++k) line.push_back({1 + 0.1 * k * k, 5 - 0.03 * k * k});
            CHECK(max_error(line, options(degree, n_control), false) <
                  1e-11);  // the line is 88 long
        }
}

TEST_CASE("points of a B-spline are fitted by a B-spline") {
    for (Index degree = 2; degree <= 5; ++degree) {
        fixtures::Spline bezier = fixtures::clamped(degree, degree + 1, 1);
        CHECK(max_error(sampled(bezier, 60, true), options(degree, degree + 1), false) <
              (degree < 4 ? 1e-9 : 1e-3));
        FitRun const run(sampled(bezier, 60, true), options(degree, degree + 1), false);
        CHECK(run.report.closure == Closure::open);
    }
    // The knots are found, too, but only approximately.
    CHECK(max_error(sampled(fixtures::clamped(3, 10, 2), 200, true), options(3, 10), false) < 0.05);
    CHECK(max_error(sampled(fixtures::clamped(3, 10, 2), 200, true), options(3, 20), false) <
          0.005);
}

TEST_CASE("as many control points as points interpolate the points") {
    for (Index degree = 1; degree <= 5; ++degree) {
        std::vector<Vec2> const points = naca({0.02, 0.4, 0.15, false}, 12);
        CHECK(max_error(points, options(degree, 24)) < 1e-6);
        CHECK(max_error(points, options(degree, 24, Closure::open)) < 1e-6);
    }
}

TEST_CASE("the error falls with the number of control points") {
    std::vector<Vec2> const points = naca({0.02, 0.4, 0.12, false}, 200);
    double before = 1;
    for (Index const n_control : {6, 10, 20, 40, 80}) {
        double const error = max_error(points, options(3, n_control));
        CHECK(error < 0.5 * before);
        before = error;
    }
    CHECK(before < 4e-7);
}

TEST_CASE("the fit turns, moves and grows with the points") {
    for (std::vector<Vec2> const& points :
         {naca({0.03, 0.4, 0.12, false}, 60), naca({0, 0.4, 0.12, true}, 61),
          fixtures::rounded_edge(60, 2e-3, 8),
          fixtures::vectors(fixtures::joukowski(0.1, 0.1, 40))}) {
        FitRun const plain(points, {});
        REQUIRE(plain.status == Status::ok);
        for (double const scale : {1e-3, 1.0, 1e4}) {
            Vec2 const by{3 * scale, -2 * scale};
            FitRun const moved(fixtures::placed(points, 0.7, scale, by), {});
            REQUIRE(moved.status == Status::ok);
            CHECK(moved.report.first_point == plain.report.first_point);
            CHECK(moved.report.max_error ==
                  doctest::Approx(plain.report.max_error * scale).epsilon(1e-5));
            std::vector<Vec2> expected;
            for (int i = 0; i < 20; ++i) expected.push_back(plain.control(i));
            expected = fixtures::placed(expected, 0.7, scale, by);
            for (int i = 0; i < 20; ++i)
                CHECK(length(moved.control(i) - expected[std::size_t(i)]) < 1e-8 * scale);
        }
    }
}

TEST_CASE("the fit does not depend on the direction of the points, nor on where a loop begins") {
    std::vector<Vec2> const points = naca({0.03, 0.4, 0.12, false}, 60);
    FitRun const plain(points, {});
    std::vector<Vec2> turned = points;
    std::reverse(turned.begin(), turned.end());
    FitRun const reversed(turned, {});
    CHECK(reversed.report.first_point == 119);
    CHECK(difference(plain, reversed, 20, 0, true) < 1e-8);
    std::rotate(turned.begin(), turned.begin() + 77, turned.end());
    FitRun const begun_elsewhere(turned, {});
    CHECK(difference(reversed, begun_elsewhere, 20, 0, false) < 1e-8);
    std::vector<Vec2> const blunt = naca({0.03, 0.4, 0.12, true}, 60);
    std::vector<Vec2> mirrored = blunt;
    std::reverse(mirrored.begin(), mirrored.end());
    FitRun const a(blunt, {}), b(mirrored, {});
    CHECK(a.fit.n_curves == 2);
    CHECK(b.fit.n_curves == 2);
    CHECK(difference(a, b, 20, 19, true) < 1e-8);
}

TEST_CASE("points that cannot be fitted are refused with the reason") {
    std::vector<Vec2> const points = naca({}, 30);
    refused(points, options(0, 20), true, "degree", 0);
    refused(points, options(6, 20), true, "degree", 6);
    refused(points, options(3, 3), true, "more than the degree", 3);
    refused(points, options(3, 61), true, "are too few to determine", 60);
    refused(naca({0, 0.4, 0.12, true}, 12, 0.8, 6), options(3, 28), true, "base", 25);
    refused(points, options(3, 20, Closure::tied), false, "loop", none);
    refused(points, options(3, 20, Closure::periodic), false, "loop", none);
    refused(std::vector<Vec2>(30, Vec2{2, 3}), {}, true, "in the same place", none);

    std::vector<Vec2> bad = points;
    bad[17].y = std::numeric_limits<double>::quiet_NaN();
    refused(bad, {}, true, "not finite", 17);
    bad[17].y = infinity;
    refused(bad, {}, true, "not finite", 17);
    bad = points;
    bad[18] = bad[17];
    refused(bad, {}, true, "are equal", 17);
    bad = points;
    bad.back() = bad.front();
    refused(bad, {}, true, "are equal", 59);
    refused(bad, {}, false, "without the last point", 59);  // a loop whose curve would be open
    refused(bad, options(3, 20, Closure::open), false, "without the last point", 59);
    bad = points;
    bad[3].x = 1e308;
    refused(bad, {}, true, "beyond 1e100", 3);
}

TEST_CASE("facets divided by further points make no blunt base at the leading edge") {
    for (int const parts : {2, 3, 4}) {
        std::vector<Vec2> const corners = naca({}, 41, 0.8, 0);
        std::vector<Vec2> points;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            Vec2 const from = corners[k], to = corners[(k + 1) % corners.size()];
            for (int i = 0; i < parts; ++i)
                points.push_back(from + (double(i) / parts) * (to - from));
        }
        FitRun const run(points, {}, true);
        CHECK(run.status == Status::ok);
        CHECK(run.report.closure == Closure::tied);
        CHECK(run.fit.n_curves == 1);
        CHECK(run.report.base_points == 0);
        CHECK(run.report.max_error < 8e-4);  // the facets themselves are that coarse
    }
}

TEST_CASE("a curve that runs back between two points is reported") {
    std::vector<Vec2> const square = fixtures::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 5);
    FitRun const run(square, options(5, 16));
    CHECK(run.status == Status::backtracks);
    Index const at = run.report.backtrack_point;
    REQUIRE(at != none);
    CHECK(run.fault.item.number == at);
    CHECK(std::string(run.fault.sentence) ==
          "the fitted curve runs backwards between points # and @; use fewer control points");
    // Near that step, some piece of the curve has a direction against the step.
    Curve const& curve = run.fit.curve[0];
    Vec2 const from = square[std::size_t(at)], to = square[std::size_t((at + 1) % 20)];
    double const begin = project(curve, from).u;
    double const end = (at + 1) % 20 == run.report.first_point ? curve.end() : project(curve, to).u;
    double least = 1;
    for (int k = 0; k <= 1000; ++k) {
        Vec2 c[2];
        curve_point(curve, begin + (end - begin) * k / 1000, 1, c);
        least = std::fmin(least, dot(c[1], to - from) / (length(c[1]) * length(to - from)));
    }
    CHECK(least < -0.2);
    CHECK(FitRun(square, options(3, 12)).report.backtrack_point == none);
}

TEST_CASE("curves through airfoils do not run back") {
    for (int const n : {20, 60, 500})
        for (Index degree = 1; degree <= 4; ++degree)
            for (bool const blunt : {false, true}) {
                FitRun const run(fixtures::rounded_to(naca({0.02, 0.4, 0.12, blunt}, n), 6),
                                 options(degree, 20));
                CHECK(run.status == Status::ok);
                CHECK(run.report.backtrack_point == none);
                CHECK(run.report.corners == (blunt ? 2 : 1));
            }
}

TEST_CASE("points whose distance is lost in rounding of the arc length are refused") {
    std::vector<Vec2> const points = {{0, 0},
                                      {1.0000000000000001e-17, 9.9999999999999998e-17},
                                      {0, 0},
                                      {1, 0.1000000000000001},
                                      {1, 0.10000000000000001},
                                      {1, 0.1000000000000001},
                                      {2, 0.40000000000000002},
                                      {2, 0.40000000000000013},
                                      {2, 0.40000000000000002},
                                      {3, 0.90000000000000013},
                                      {3, 0.90000000000000002},
                                      {3, 0.90000000000000013},
                                      {2.9999999999999996, 1.6000000000000001},
                                      {4, 1.6000000000000001}};
    CHECK(FitRun(points, options(1, 11), false).status == Status::bad_curve);
}

TEST_CASE("fits of random points that are not refused are well-formed curves") {
    std::mt19937 random(34);
    auto const between = [&](double low, double high) {
        return low + (high - low) * (double(random()) / 4294967296.0);
    };
    int fitted = 0, warned = 0, not_fitted = 0;
    for (int trial = 0; trial < 600; ++trial) {
        int const n = 6 + int(random() % 20), degree = 1 + trial % 5;
        double const unit = trial % 3 == 0 ? 9e99 : 1, tiny = trial % 2 == 0 ? 1e-16 : 1e-3;
        std::vector<Vec2> points;
        for (int k = 0; k < n; ++k) {
            double const angle = 2 * std::acos(-1.0) * std::pow(double(k) / n, between(1, 1.2));
            Vec2 p{std::cos(angle), 0.1 * std::sin(angle)};
            if (k > 0 && random() % 10 == 0)
                p = points.back() + Vec2{tiny * between(-1, 1), tiny * between(-1, 1)};
            points.push_back(p);
        }
        for (Vec2& p : points) p = unit * p;
        FitRun const run(points, options(degree, degree + 1 + Index(random() % 4)), trial % 4 != 0);
        if (failed(run.status)) {
            ++not_fitted;
            continue;
        }
        ++(run.status == Status::ok ? fitted : warned);
        Fault fault;
        for (Index c = 0; c < run.fit.n_curves; ++c)
            CHECK(check_curve(run.fit.curve[c], c, fault) == Status::ok);
    }
    CHECK(fitted > 50);
    CHECK(warned > 50);
    CHECK(not_fitted > 50);
}

namespace {

// Moves each coordinate by one unit in the last place up, down, or not at all.
std::vector<Vec2> one_ulp_off(std::vector<Vec2> points, std::uint64_t seed) {
    fixtures::SectionRandom random(seed);
    for (Vec2& p : points)
        for (double* const x : {&p.x, &p.y})
            if (int const way = random.whole(-1, 1)) *x = std::nextafter(*x, way * 10.0);
    return points;
}

// The largest distance of the curve from the whole polygon of the points: an independent measure.
double departure(FitRun const& run, std::vector<Vec2> const& points) {
    Curve const& curve = run.fit.curve[0];
    double worst = 0;
    for (int k = 0; k <= 1500; ++k) {
        Vec2 const c = curve_point(curve, curve.begin() + (curve.end() - curve.begin()) * k / 1500);
        double nearest = 1;
        for (std::size_t i = 0; i < points.size(); ++i) {
            Vec2 const a = points[i], side = points[(i + 1) % points.size()] - a;
            double const along = std::fmin(1, std::fmax(0, dot(c - a, side) / square(side)));
            nearest = std::fmin(nearest, length(c - (a + along * side)));
        }
        worst = std::fmax(worst, nearest);
    }
    return worst;
}

}  // namespace

TEST_CASE("one unit in the last place of the points moves no control point by 1e-9") {
    for (std::vector<Vec2> const& points :
         {naca({0, 0.4, 0.12, false}, 61), naca({0.03, 0.4, 0.12, false}, 70),
          naca({0.02, 0.5, 0.1, true}, 64), naca({0, 0.4, 0.12, false}, 61, 1.0)}) {
        for (int const n_control : {20, 25, 30, 35, 40}) {
            FitRun const plain(points, options(3, n_control));
            REQUIRE(plain.status == Status::ok);
            for (std::uint64_t seed = 1; seed <= 3; ++seed) {
                FitRun const other(one_ulp_off(points, seed), options(3, n_control));
                REQUIRE(other.status == Status::ok);
                CHECK(difference(plain, other, n_control, 0, false) < 1e-9);
            }
            FitRun const turned(fixtures::placed(points, fixtures::pi / 4, 1, {0, 0}),
                                options(3, n_control));
            REQUIRE(turned.status == Status::ok);
            std::vector<Vec2> back;
            for (int i = 0; i < n_control; ++i) back.push_back(turned.control(i));
            back = fixtures::placed(back, -fixtures::pi / 4, 1, {0, 0});
            for (int i = 0; i < n_control; ++i)
                CHECK(length(back[std::size_t(i)] - plain.control(i)) < 1e-9);
        }
    }
}

TEST_CASE("curves stay near the polygon of the points, and the report says where they do not") {
    fixtures::SectionRandom random(11);
    int members = 0, far = 0, open = 0;
    for (int number = 0; number < 60; ++number) {
        std::vector<Vec2> points;
        for (fixtures::Point const point : fixtures::section_to_fit(number, random))
            points.push_back({point.x, point.y});
        FitRun const run(points, {});
        if (int(points.size()) < 20) continue;
        REQUIRE_MESSAGE(!failed(run.status), run.fault.sentence);
        double const found = departure(run, points);
        CAPTURE(number);
        CHECK(found < run.report.max_departure * 1.01 + 1e-6);
        CHECK(found < 5e-3);
        CHECK(run.report.departure_point != none);
        ++members;
        if (run.report.max_departure > 2e-3) ++far;
        if (run.fit.n_curves == 2) ++open;
    }
    CHECK(members > 50);
    CHECK(open > 15);
    CHECK(far <= members / 20 + 1);
}

TEST_CASE("what keeps a curve near the polygon does not cost more at the points than it gains") {
    // Equal weights ask for the curve that is nearest to the points, wherever it runs between them.
    fixtures::SectionRandom random(12);
    int kept_near = 0;
    for (int number = 0; number < 30; ++number) {
        std::vector<Vec2> points;
        for (fixtures::Point const point : fixtures::section_to_fit(number, random))
            points.push_back({point.x, point.y});
        std::vector<double> const equal(points.size(), 1.0);
        for (Index const n_control : {6, 8, 10, 12}) {
            if (int(points.size()) < n_control) continue;
            FitOptions wish = options(3, n_control);
            FitRun const near_both(points, wish);
            wish.weight = equal.data();
            FitRun const nearest(points, wish);
            REQUIRE_MESSAGE(!failed(near_both.status), near_both.fault.sentence);
            REQUIRE_MESSAGE(!failed(nearest.status), nearest.fault.sentence);
            // An error at the points of .0003 chords is as bad as .0017 between them.
            auto const cost = [](FitRun const& run) {
                return std::fmax(run.report.max_error / 3e-4, run.report.max_departure / 1.7e-3);
            };
            CAPTURE(number);
            CAPTURE(n_control);
            CHECK(cost(near_both) < cost(nearest) * 1.001);
            if (cost(near_both) < 0.99 * cost(nearest)) ++kept_near;
        }
    }
    CHECK(kept_near > 20);
}

TEST_CASE("bases of up to half the chord and wide wedges get a straight curve of their own") {
    for (double const base : {0.05, 0.2, 0.3, 0.45, 0.5})
        for (int const side : {20, 60}) {
            std::vector<Vec2> points;
            for (int k = side; k > -side - 1; --k) {
                double const s = std::fabs(k) / double(side);
                double const x = 0.5 * (1 - std::cos(fixtures::pi * s));
                points.push_back(
                    {x, (k > 0 ? 1 : -1) * (0.1 * std::sqrt(x) * (1 - x) + 0.5 * base * x)});
            }
            FitRun const run(points, {});
            REQUIRE(!failed(run.status));
            CAPTURE(base);
            CHECK(run.report.base_points == 2);
            CHECK(run.fit.n_curves == 2);
            CHECK(run.report.first_point == 0);
            CHECK(departure(run, points) < 3e-3);
        }
    // A wedge of 60 degrees with a base behind it.
    std::vector<Vec2> wedge;
    for (int k = -40; k <= 40; ++k) {
        double const s = std::fabs(k) / 40.0, x = s * s;
        wedge.push_back({x, (k < 0 ? 1 : -1) * (0.2 * std::sqrt(x) * (1 - x) + 0.29 * x * x)});
    }
    FitRun const run(wedge, {});
    REQUIRE(!failed(run.status));
    CHECK(run.report.base_points == 2);
}
