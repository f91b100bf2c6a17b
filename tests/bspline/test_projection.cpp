#include <doctest/doctest.h>

#include "bspline/projection.hpp"

#include <fixtures/spline.hpp>

using namespace harmorph;
using fixtures::Spline;

namespace {

double distance_by_brute_force(Curve const& curve, Vec2 point) {
    double least = infinity;
    for (int k = 0; k <= 20000; ++k) {
        double const u = curve.begin() + (curve.end() - curve.begin()) * k / 20000.0;
        least = std::fmin(least, length(curve_point(curve, u) - point));
    }
    return least;
}

}  // namespace

TEST_CASE("points of a curve get their parameter back") {
    for (int degree = 1; degree <= 5; ++degree)
        for (Spline const& spline :
             {fixtures::clamped(degree, 12, 1), fixtures::periodic(degree, 11, 0.4, 2)}) {
            Curve const curve = spline.curve();
            for (int k = 0; k < 200; ++k) {
                double const u = curve.begin() + (curve.end() - curve.begin()) * (k + 0.5) / 200;
                Projection const found = project(curve, curve_point(curve, u));
                CHECK(found.distance < 1e-13);
                CHECK(found.u == doctest::Approx(u).epsilon(1e-11));
            }
        }
}

TEST_CASE("a point off along the normal has its foot where the normal begins") {
    Spline const spline = fixtures::periodic(3, 12, 0.6, 3);
    Curve const curve = spline.curve();
    for (int k = 0; k < 100; ++k)
        for (double const off : {-1e-2, 1e-6, 1e-3}) {
            double const u = 12 * (k + 0.3) / 100;
            Vec2 c[2];
            curve_point(curve, u, 1, c);
            Vec2 const normal = (1 / length(c[1])) * Vec2{-c[1].y, c[1].x};
            Projection const found = project(curve, c[0] + off * normal);
            CHECK(found.u == doctest::Approx(u).epsilon(1e-9));
            CHECK(std::fabs(found.distance - std::fabs(off)) < 1e-15);
        }
}

TEST_CASE("the nearest point is found from everywhere, and at corners too") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-3, 3);
    Spline corner = fixtures::clamped(3, 9, 5);
    for (std::size_t k = 5; k < 8; ++k) corner.knots[k] = 3;
    for (Spline const& spline :
         {fixtures::clamped(5, 9, 6), fixtures::periodic(2, 7, 0.05, 7), corner}) {
        Curve const curve = spline.curve();
        for (int k = 0; k < 100; ++k) {
            Vec2 const point{2 * uniform(random), uniform(random)};
            Projection const found = project(curve, point);
            double const expected = distance_by_brute_force(curve, point);
            CHECK(found.distance <= expected);
            CHECK(found.distance > expected - 1e-3);
            CHECK(length(curve_point(curve, found.u) - point) == found.distance);
            Projection const again =
                harmorph::Projector(curve).nearest(point, curve.begin(), curve.end(), found.u);
            CHECK(again.distance == doctest::Approx(found.distance).epsilon(1e-14));
        }
    }
}

TEST_CASE("the projection stays within the given part of the curve") {
    Spline const spline = fixtures::clamped(3, 12, 8);
    Curve const curve = spline.curve();
    Vec2 const point = curve_point(curve, 2.5);
    CHECK(project(curve, point, 3, 5).u == 3);
    CHECK(project(curve, point, 1, 2.25).u == 2.25);
    CHECK(project(curve, point, 2.4, 2.6).u == doctest::Approx(2.5).epsilon(1e-12));
    CHECK(project(curve, point, 4.5, 4.5).u == 4.5);
}

TEST_CASE("a place that coincides with an end within rounding is the end") {
    Spline spline = fixtures::clamped(3, 10, 9);
    for (double const shift : {0.0, 1e3}) {
        for (double& c : spline.control) c += shift;
        Curve const curve = spline.curve();
        Vec2 const begin = curve_point(curve, curve.begin()), end = curve_point(curve, curve.end());
        for (double const wobble : {-2 * epsilon, 0.0, 2 * epsilon}) {
            CHECK(project(curve, {begin.x * (1 + wobble), begin.y * (1 - wobble)}).u ==
                  curve.begin());
            CHECK(project(curve, {end.x * (1 - wobble), end.y * (1 + wobble)}).u == curve.end());
        }
    }
}

TEST_CASE("closed curves are distinguished from open ones, and smooth seams from corners") {
    CHECK(!is_closed(fixtures::clamped(3, 9, 1).curve()));
    for (int degree = 2; degree <= 5; ++degree)
        CHECK(is_periodic(fixtures::periodic(degree, 9, 0.3, 2).curve()));
    Spline tied = fixtures::clamped(3, 9, 3);
    tied.indices = {0, 1, 2, 3, 4, 5, 6, 7, 0};
    CHECK(is_closed(tied.curve()));
    CHECK(!is_periodic(tied.curve()));
}
