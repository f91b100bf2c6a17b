// The energy of a triangle: derivatives against differences, invariances, convexity, and where it
// is smallest.
#include <doctest/doctest.h>

#include "safe/untangle.hpp"

#include "safe/corner_map.hpp"

#include <cmath>
#include <random>

using harmorph::Distortion;
using harmorph::Triangle;
using harmorph::Vec2;

namespace {

double random_number(std::mt19937& random) { return double(random()) / 2147483648.0 - 1; }
Vec2 random_point(std::mt19937& random) { return {random_number(random), random_number(random)}; }

// A reference with positive area, and another triangle, inverted or not.
struct Pair {
    Triangle reference, now;

    explicit Pair(std::mt19937& random) {
        do {
            for (Vec2& point : reference.at) point = random_point(random);
        } while (reference.twice_area() < 0.2);
        for (Vec2& point : now.at) point = random_point(random);
    }
};

double& coordinate(Triangle& triangle, int k) {
    return k % 2 == 0 ? triangle.at[k / 2].x : triangle.at[k / 2].y;
}
double component(Vec2 v, int k) { return k % 2 == 0 ? v.x : v.y; }

struct Derivatives {
    harmorph::CellForm<3> form;

    Derivatives(Pair const& pair, double softness, double least) {
        harmorph::CornerForm corner;
        Distortion(pair.reference).differentiate(pair.now, softness, least, corner);
        form.add(0, 1, 2, corner);
    }
    double gradient(int i) const { return component(form.by[i / 2], i); }
    double hessian(int i, int j) const {
        harmorph::Block const& block = form.hessian[i / 2][j / 2];
        return i % 2 == 0 ? component({block.a, block.b}, j) : component({block.c, block.d}, j);
    }
};

constexpr double exact = -1e300;  // no curvature is raised

}  // namespace

TEST_CASE("the gradient is that of the untangling energy, and the Hessian that of the gradient") {
    std::mt19937 random(1);
    int inverted = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Pair const pair(random);
        double const softness = 0.3 + 0.3 * (trial % 4);
        Distortion const distortion(pair.reference);
        inverted += distortion.determinant(pair.now) < 0;
        Derivatives const here(pair, softness, exact);
        double scale = 0, scale_of_hessian = 0;
        for (int i = 0; i < 6; ++i) {
            scale = std::fmax(scale, std::fabs(here.gradient(i)));
            for (int j = 0; j < 6; ++j)
                scale_of_hessian = std::fmax(scale_of_hessian, std::fabs(here.hessian(i, j)));
        }
        double const h = 1e-5;
        for (int i = 0; i < 6; ++i) {
            Pair ahead = pair, behind = pair;
            coordinate(ahead.now, i) += h;
            coordinate(behind.now, i) -= h;
            double const rise =
                distortion.energy(ahead.now, softness) - distortion.energy(behind.now, softness);
            CHECK(std::fabs(here.gradient(i) - rise / (2 * h)) < 1e-6 * (scale + scale_of_hessian));
            Derivatives const after(ahead, softness, exact), before(behind, softness, exact);
            for (int j = 0; j < 6; ++j) {
                double const bend = (after.gradient(j) - before.gradient(j)) / (2 * h);
                CHECK(std::fabs(here.hessian(i, j) - bend) < 1e-5 * scale_of_hessian);
            }
        }
    }
    CHECK(inverted > 50);
    CHECK(inverted < 150);
}

TEST_CASE("curvatures are raised to a multiple of the energy's own and never lowered") {
    std::mt19937 random(2);
    int raised = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Pair const pair(random);
        Distortion const distortion(pair.reference);
        harmorph::DensityDerivatives const by = distortion.derivatives(pair.now, 0.1);
        harmorph::Curvatures const free = distortion.map().curvatures(pair.now, by, exact),
                                   convex = distortion.map().curvatures(pair.now, by, 0.25);
        double const floor =
            0.25 * 4 / harmorph::regularised(distortion.determinant(pair.now), 0.1);
        for (int k = 0; k < 4; ++k) {
            raised += free.value[k] < floor;
            CHECK(convex.value[k] ==
                  doctest::Approx(std::fmax(free.value[k], floor)).epsilon(1e-14));
            CHECK(convex.value[k] > 0);
        }
    }
    CHECK(raised > 20);
}

TEST_CASE("the energy is smallest where the triangle is its reference, turned and moved at will") {
    std::mt19937 random(3);
    for (int trial = 0; trial < 50; ++trial) {
        Pair pair(random);
        Distortion const distortion(pair.reference);
        double const c = std::cos(1.0 * trial), s = std::sin(1.0 * trial);
        for (int k = 0; k < 3; ++k) {
            Vec2 const p = pair.reference.at[k];
            pair.now.at[k] = {c * p.x - s * p.y + 5, s * p.x + c * p.y - 3};
        }
        double const least = 2 + 2 * Distortion::size_weight;  // (|I|^2 + 2 size_weight) / 1
        CHECK(distortion.determinant(pair.now) == doctest::Approx(1));
        CHECK(distortion.energy(pair.now, 0) == doctest::Approx(least).epsilon(1e-12));
        Derivatives const here(pair, 0, exact);
        for (int k = 0; k < 6; ++k) CHECK(std::fabs(here.gradient(k)) < 1e-12);
        harmorph::Curvatures const free =
            distortion.map().curvatures(pair.now, distortion.derivatives(pair.now, 0), exact);
        for (double const value : free.value) CHECK(value > -1e-11);
        for (int k = 0; k < 20; ++k) {
            Triangle other = pair.now;
            for (Vec2& point : other.at) point = point + 0.3 * random_point(random);
            if (distortion.determinant(other) <= 0) continue;
            CHECK(distortion.energy(other, 0) >= least * (1 - 1e-12));
        }
    }
}

TEST_CASE("the regularised determinant lies above the positive part by the softness at most") {
    for (double const softness : {1.0, 1e-3, 1e-9}) {
        CHECK(harmorph::regularised(0, softness) == doctest::Approx(softness / 2));
        double const folded = 0.5 * softness * softness / (std::sqrt(1 + softness * softness) + 1);
        CHECK(harmorph::regularised(-1, softness) == doctest::Approx(folded).epsilon(1e-14));
        double last = 0;
        for (double const d : {-1e6, -3.0, -1e-3, 0.0, 1e-3, 1.0, 7.0}) {
            double const chi = harmorph::regularised(d, softness);
            CHECK(chi > last);
            CHECK(chi - std::fmax(d, 0) <= softness / 2);
            last = chi;
        }
    }
    CHECK(harmorph::regularised(2.5, 0) == 2.5);
    CHECK(harmorph::regularised(-2.5, 0) == 0);
}
