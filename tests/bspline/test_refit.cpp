#include <doctest/doctest.h>

#include "bspline/refit.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

#include <algorithm>
#include <string>

using namespace harmorph;
using fixtures::FitRun;
using fixtures::Naca4;

namespace {

struct RefitRun {
    std::unique_ptr<fixtures::Guarded> block;
    Refit refit;
    RefitReport report;
    Fault fault;
    Status status;

    RefitRun(Curve const& curve, Curve const* base, std::vector<Vec2> const& points,
             RefitOptions const& options = {}) {
        auto const n = Index(points.size());
        block = fixtures::laid_out_part(refit, curve, n);
        status = refit.run(curve, base, {&points[0].x, &points[0].y, 2}, n, options, report, fault);
    }
    Vec2 control(Index i) const { return {refit.control[2 * i], refit.control[2 * i + 1]}; }
};

std::vector<Vec2> naca(Naca4 const& shape) { return fixtures::naca(shape, 60); }

std::vector<Vec2> sampled(Curve const& curve, int n) {
    std::vector<Vec2> out;
    for (int k = 0; k < n; ++k)
        out.push_back(curve_point(curve, curve.begin() + (curve.end() - curve.begin()) * k / n));
    return out;
}

double difference(RefitRun const& a, RefitRun const& b) {
    double out = 0;
    for (Index i = 0; i < a.refit.control.count(); ++i)
        out = std::fmax(out, std::fabs(a.refit.control[i] - b.refit.control[i]));
    return out;
}

int crossings(std::vector<Vec2> const& line) {
    auto const crosses = [&](std::size_t i, std::size_t j) {
        Vec2 const a = line[i], b = line[i + 1], c = line[j], d = line[j + 1];
        return triangle_area(a, b, c) * triangle_area(a, b, d) < 0 &&
               triangle_area(c, d, a) * triangle_area(c, d, b) < 0;
    };
    int out = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        for (std::size_t j = i + 2; j + 1 < line.size(); ++j) out += crosses(i, j) ? 1 : 0;
    return out;
}

Naca4 const plain_section{0, 0.4, 0.12, false}, cambered{0.04, 0.4, 0.15, false};
FitOptions const twenty{3, 20, Closure::automatic};

}  // namespace

TEST_CASE("a section that the curve already has moves nothing, and a moved curve is found again") {
    for (Closure const closure : {Closure::tied, Closure::periodic}) {
        FitRun const fit(naca(plain_section), {3, 20, closure});
        REQUIRE(!failed(fit.status));
        Curve curve = fit.fit.curve[0];
        RefitRun const same(curve, nullptr, sampled(curve, 400));
        REQUIRE_MESSAGE(!failed(same.status), same.fault.sentence);
        CHECK(same.report.max_error < 4e-6);
        for (Index i = 0; i < 20; ++i) CHECK(length(same.control(i) - fit.control(i)) < 1e-3);
        std::vector<double> moved(fit.fit.control.begin(), fit.fit.control.end());
        for (std::size_t i = 8; i < 14; ++i) moved[i] += 0.01;
        Curve other = curve;
        other.control = moved.data();
        RefitRun const found(curve, nullptr, sampled(other, 400));
        REQUIRE(!failed(found.status));
        CHECK(found.report.max_error < 8e-5);
    }
}

TEST_CASE("NACA sections are refitted as well as by a new fit") {
    double last = 1;
    for (Index const n : {12, 20, 40}) {
        FitRun const fit(naca(plain_section), {3, n, Closure::automatic});
        FitRun const best(naca(cambered), {3, n, Closure::automatic});
        RefitRun const run(fit.fit.curve[0], nullptr, naca(cambered));
        REQUIRE_MESSAGE(!failed(run.status), run.fault.sentence);
        CHECK(run.report.max_error < 20 * best.report.max_error);
        CHECK(run.report.max_error < 0.5 * last);
        last = run.report.max_error;
        CHECK(std::fabs(run.report.chord - 1) < 2e-3);
        CHECK(run.report.closed_width == 0);
    }
}

// Camber far in front: without a bound on the slide of control points some moved curves cross
// themselves at the leading edge, although all points are near the curve.
TEST_CASE("the moved curve does not cross itself") {
    FitRun const fit(naca(plain_section), twenty);
    for (double const camber : {0.03, 0.05, 0.07}) {
        for (double const front : {0.15, 0.2, 0.25}) {
            for (double const thickness : {0.12, 0.16, 0.2}) {
                RefitRun const run(fit.fit.curve[0], nullptr,
                                   naca({camber, front, thickness, false}));
                REQUIRE(!failed(run.status));
                Curve moved = fit.fit.curve[0];
                moved.control = run.refit.control.data();
                INFO("camber = " << camber << ", front = " << front
                                 << ", thickness = " << thickness);
                CHECK(crossings(sampled(moved, 300)) == 0);
            }
        }
    }
}

TEST_CASE("the beginning, direction, unit and place of the section do not matter") {
    FitRun const fit(naca(plain_section), twenty);
    Curve const curve = fit.fit.curve[0];
    std::vector<Vec2> points = naca(cambered);
    RefitRun const first(curve, nullptr, points);
    std::rotate(points.begin(), points.begin() + 37, points.end());
    CHECK(difference(first, {curve, nullptr, points}) < 1e-9);
    std::reverse(points.begin(), points.end());
    CHECK(difference(first, {curve, nullptr, points}) < 1e-9);
    RefitRun const on_chord(curve, nullptr, points, {true, true});
    RefitRun const elsewhere(curve, nullptr, fixtures::placed(points, 0.7, 250, {9, -4}),
                             {true, true});
    CHECK(difference(on_chord, elsewhere) < 1e-9);
    CHECK(std::fabs(on_chord.report.chord - elsewhere.report.chord) < 1e-12);
    // The chord of a given curve and its points in millimetres.
    std::vector<double> control(fit.fit.control.begin(), fit.fit.control.end());
    for (double& c : control) c *= 1000;
    Curve large = curve;
    large.control = control.data();
    RefitRun const scaled(large, nullptr, fixtures::placed(points, 0, 1000, {}));
    for (Index i = 0; i < 20; ++i)
        CHECK(length(scaled.control(i) - 1000.0 * first.control(i)) < 1e-6);
}

TEST_CASE("a blunt curve moves its base along, and a sharp or round curve closes a blunt section") {
    Naca4 const blunt{0, 0.4, 0.12, true}, other{0.03, 0.4, 0.16, true};
    FitRun const fit(naca(blunt), twenty);
    REQUIRE(fit.fit.n_curves == 2);
    RefitRun const run(fit.fit.curve[0], &fit.fit.curve[1], naca(other));
    REQUIRE_MESSAGE(!failed(run.status), run.fault.sentence);
    CHECK(run.report.max_error < 3e-4);
    std::vector<Vec2> const outline = naca(other);
    CHECK(length(run.control(0) - outline[4]) < 1e-12);

    FitRun const sharp(naca(plain_section), twenty);
    RefitRun const closed(sharp.fit.curve[0], nullptr, naca(other));
    REQUIRE(!failed(closed.status));
    CHECK(std::fabs(closed.report.closed_width - length(outline[4] - outline[0])) < 1e-12);
}

TEST_CASE("points that are no airfoil, or lack the base of the curve, are refused") {
    FitRun const sharp(naca(plain_section), twenty);
    FitRun const blunt(naca({0, 0.4, 0.12, true}), twenty);
    auto const refused = [](RefitRun const& run, char const* words) {
        CHECK(run.status == Status::bad_curve);
        CHECK_MESSAGE(std::string(run.fault.sentence).find(words) != std::string::npos,
                      run.fault.sentence);
    };
    std::vector<Vec2> const section = naca(cambered);
    refused({blunt.fit.curve[0], &blunt.fit.curve[1], section}, "which cannot vanish");
    std::vector<Vec2> upper(section.begin(), section.begin() + 61);
    refused({sharp.fit.curve[0], nullptr, upper, {false, false}},
            "points are not the outline of an airfoil");
    FitRun const side(upper, {3, 12, Closure::open}, false);
    refused({side.fit.curve[0], nullptr, section}, "curve is not the outline of an airfoil");
    std::vector<Vec2> twice = section;
    twice[5] = twice[6];
    refused({sharp.fit.curve[0], nullptr, twice}, "are equal");
    fixtures::Spline eight = fixtures::clamped(3, 8, 1);
    eight.indices = {0, 1, 2, 3, 2, 4, 5, 0};
    refused({eight.curve(), nullptr, section}, "uses control point # twice");
}
