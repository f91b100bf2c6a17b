// What a safe morph spends, what the report says about this, and what it brings.
#include <fixtures/channels.hpp>
#include <fixtures/fitted.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

double product_of(hm_safe_report const& report) { return report.min_quality * report.mean_quality; }

// A section whose points have given displacements, in an O-mesh with thin layers.
Case layered_section(int n, double first) {
    Case out;
    out.mesh = o_mesh(naca4({}, n), stretched(first, 20, 36));
    out.set_given(body);
    return out;
}

Field cambered(SafeDisplaced const& safe, double height) {
    Field out;
    for (Complex const z : safe.start()) out.push_back({0, 4 * height * z.real() * (1 - z.real())});
    return out;
}

// The part behind x = .9 turns about (.7, 0), and the part from .5 on bends.
Field flapped(SafeDisplaced const& safe, double degrees) {
    Field out;
    for (Complex const z : safe.start()) {
        double const s = std::min(std::max((z.real() - 0.5) / 0.4, 0.0), 1.0);
        Complex const turn = std::polar(1.0, s * s * (3 - 2 * s) * degrees * pi / 180);
        out.push_back((z - 0.7) * (turn - 1.0));
    }
    return out;
}

// A unit square whose lower side has given displacements, between sides along which points slip.
Case turned_floor(int n) {
    Case out;
    out.mesh = square(n, Cells::quads);
    out.set_given(bottom);
    out.set_slip(left);
    out.set_slip(right);
    return out;
}

Field turned(SafeDisplaced const& safe, double degrees, double part = 1) {
    Field out;
    for (Complex const z : safe.start())
        out.push_back(part * (z - Complex(0.25, 0)) * (std::polar(1.0, degrees * pi / 180) - 1.0));
    return out;
}

}  // namespace

TEST_CASE("thin layers stay on a wall that bends, and neither smallest nor mean quality falls") {
    for (double const first : {3e-4, 1e-3}) {
        Case setup = layered_section(44, first);
        SafeDisplaced safe(setup);
        for (double const height : {0.15, 0.25}) {
            Field const wall = cambered(safe, height);
            safe.safe_options.min_quality = -1;
            safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR});
            REQUIRE(safe.run(wall) == HM_OK);
            hm_safe_report const linear = safe.safe_report;
            safe.safe_options.min_quality = 0;
            safe.safe_options.skipped_strategies = 0;
            REQUIRE(safe.run(wall) == HM_OK);
            hm_safe_report const& report = safe.safe_report;
            INFO(first << ", camber " << height << ": " << linear.min_quality << "/"
                       << linear.mean_quality << " to " << report.min_quality << "/"
                       << report.mean_quality << ", " << report.solutions << " solutions");
            CHECK(report.min_quality >= linear.min_quality);
            CHECK(report.mean_quality > 1.03 * linear.mean_quality);
            // Tops whose cells would be poor in their places, at the trailing edge, are free.
            CHECK(report.mean_height_ratio == doctest::Approx(1).epsilon(0.02));
            CHECK(report.solutions <= 20);
        }
    }
}

TEST_CASE("a flap turns on its way, so that it neither shrinks nor passes through the section") {
    for (double const degrees : {-140.0, 140.0}) {
        for (double const first : {2e-3, 2e-2}) {
            Case setup = layered_section(44, first);
            SafeDisplaced safe(setup);
            safe.safe_options.min_quality = 0;
            Field const wall = flapped(safe, degrees);
            INFO(degrees << " degrees, first layer " << first);
            CHECK(safe.run(wall) == HM_OK);
            INFO(safe.safe_report.step_fraction << ", " << safe.safe_report.min_quality << "/"
                                                << safe.safe_report.mean_quality << " after "
                                                << safe.safe_report.solutions << " solutions");
            CHECK(safe.safe_report.step_fraction == 1);
            CHECK(safe.safe_report.min_quality > 0.3);
            CHECK(safe.safe_report.solutions <= 24);
        }
    }
}

TEST_CASE("more solutions give better cells where the report says so, and else change nothing") {
    int more = 0, enough = 0;
    for (double const height : {0.1, 0.25}) {
        Case setup = layered_section(40, 0.02);
        SafeDisplaced safe(setup);
        safe.safe_options.min_quality = 0;
        Field const wall = cambered(safe, height);
        double last = 0;
        bool was_limited = true;
        for (std::int32_t const work : {1, 3, 40, 80}) {
            safe.safe_options.improve_work = work;
            REQUIRE(safe.run(wall) == HM_OK);
            hm_safe_report const& report = safe.safe_report;
            INFO("camber " << height << ", " << work << " solutions: " << product_of(report));
            CHECK(report.solutions - report.resolves <= work);
            CHECK(product_of(report) >= last);
            if (!was_limited) CHECK(product_of(report) == last);
            was_limited = report.may_improve != 0;
            (was_limited ? more : enough) += 1;
            last = product_of(report);
        }
    }
    CHECK(more > 0);
    CHECK(enough > 0);
}

TEST_CASE("a mean quality that falls by more than 2 % is raised again, and less costs nothing") {
    int raised = 0, left = 0;
    Case setup = layered_section(44, 1e-3);
    SafeDisplaced safe(setup);
    safe.safe_options.min_quality = 0;
    REQUIRE(safe.run(turned(safe, 0)) == HM_OK);
    double const start = safe.safe_report.mean_quality;
    for (double const degrees : {1.0, 3.0, 25.0, 30.0, 35.0}) {
        Field const wall = turned(safe, degrees);
        safe.safe_options.skipped_strategies = 1 << HM_STRATEGY_IMPROVED;
        REQUIRE(safe.run(wall) >= HM_OK);
        hm_safe_report const one = safe.safe_report;
        safe.safe_options.skipped_strategies = 0;
        REQUIRE(safe.run(wall) >= HM_OK);
        hm_safe_report const both = safe.safe_report;
        INFO(degrees << " degrees: mean " << one.mean_quality << " and " << both.mean_quality);
        CHECK(both.min_quality >= (1 - 1e-9) * one.min_quality);
        CHECK(both.mean_quality >= one.mean_quality);
        bool const is_between = one.mean_quality > 0.95 * start && one.mean_quality < 0.98 * start;
        raised += is_between && product_of(both) > 1.02 * product_of(one);
        if (one.mean_quality < 0.985 * start || one.min_quality < 0.985 * one.start_quality)
            continue;
        ++left;
        CHECK(both.solutions == one.solutions);
    }
    CHECK(raised > 0);
    CHECK(left > 0);
}

TEST_CASE("a movement that cannot be completed ends after 200 solutions; its part can be reached") {
    int refused = 0;
    for (int const n : {12, 16}) {
        for (double const degrees : {55.0, 70.0}) {
            Case setup = turned_floor(n);
            SafeDisplaced safe(setup);
            safe.safe_options.min_quality = 0;
            hm_status const status = safe.run(turned(safe, degrees));
            hm_safe_report const report = safe.safe_report;
            INFO(n << " cells, " << degrees << " degrees: " << report.step_fraction << " after "
                   << report.solutions << " solutions");
            // Untangling counts by its time, so one untangling may exceed the limit.
            CHECK(report.solutions <= 205);
            if (status != HM_SHORT) continue;
            ++refused;
            CHECK(report.step_fraction > 0.3);
            REQUIRE(safe.run(turned(safe, degrees, 0.97 * report.step_fraction)) == HM_OK);
            CHECK(safe.safe_report.step_fraction == 1);
        }
    }
    CHECK(refused > 0);
}

TEST_CASE(
    "a part of a movement has the quality asked for, and the part is smaller for more of it") {
    int poor = 0, smaller = 0;
    for (int const n : {12, 16}) {
        for (double const degrees : {42.0, 55.0, 70.0}) {
            Case setup = turned_floor(n);
            SafeDisplaced safe(setup);
            double last = 1;
            for (double const asked : {-1.0, 0.0, 0.3}) {
                safe.safe_options.min_quality = asked;
                hm_status const status = safe.run(turned(safe, degrees));
                hm_safe_report const report = safe.safe_report;
                INFO(n << " cells, " << degrees << " degrees, " << asked << ": "
                       << report.step_fraction << " with " << report.min_quality);
                if (status != HM_SHORT) continue;
                double const least = (asked == 0 ? 0.05 : asked) * report.start_quality;
                if (asked >= 0) CHECK(report.min_quality >= least);
                poor += asked < 0 && report.min_quality < 0.05 * report.start_quality;
                CHECK(report.step_fraction > 0.2);
                CHECK(report.step_fraction < last + 0.02);  // parts are found to .02
                smaller += report.step_fraction < last - 0.02;
                last = report.step_fraction;
            }
        }
    }
    CHECK(poor > 0);  // else the test has not seen what it is about
    CHECK(smaller > 0);
}

TEST_CASE("control points and the same displacements of the wall end with cells alike") {
    Case floor = channel(10, 12, 0.01, 12), airfoil;
    airfoil.mesh = o_mesh(naca4({}, 36), stretched(0.01, 8, 24));
    airfoil.curves = fitted_loop(naca4({}, 36).points, 14);
    airfoil.put_on_curves(body);
    for (Case* const setup : {&floor, &airfoil}) {
        Safe by_curve(*setup);
        by_curve.safe_options.min_quality = 0;
        Case given = given_instead(*setup);
        SafeDisplaced by_points(given);
        by_points.safe_options.min_quality = 0;
        std::size_t const n = setup->curves.control.size() / 2;
        for (double const height : {0.15, 0.3}) {
            std::vector<double> move(2 * n, 0.0);
            bool const is_airfoil = setup == &airfoil;
            for (std::size_t k = is_airfoil ? 0 : 1; k + (is_airfoil ? 0 : 1) < n; ++k) {
                double const x = setup->curves.control[2 * k] - (is_airfoil ? 0 : 1);
                move[2 * k + 1] = 4 * height * x * (1 - x);
            }
            REQUIRE(by_curve.run(move) == HM_OK);
            Field wall;
            for (std::int32_t const point : by_points.points) {
                std::size_t const k = std::size_t(point);
                wall.push_back(
                    {by_curve.x[k] - setup->mesh.x[k], by_curve.y[k] - setup->mesh.y[k]});
            }
            REQUIRE(by_points.run(wall) == HM_OK);
            INFO(height << ": " << by_curve.report.min_quality << "/"
                        << by_curve.report.mean_quality << " and "
                        << by_points.safe_report.min_quality << "/"
                        << by_points.safe_report.mean_quality);
            CHECK(by_points.safe_report.min_quality ==
                  doctest::Approx(by_curve.report.min_quality).epsilon(0.02));
            CHECK(by_points.safe_report.mean_quality ==
                  doctest::Approx(by_curve.report.mean_quality).epsilon(0.02));
        }
    }
}
