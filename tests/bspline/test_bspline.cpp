#include <doctest/doctest.h>

#include "bspline/bspline.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/traps.hpp>

#include <limits>
#include <string>

using namespace harmorph;
using fixtures::Spline;
using fixtures::with_weights;

namespace {

double value_sum(CurveBasis const& basis, int derivative) {
    double sum = 0;
    for (int k = 0; k < basis.order; ++k) sum += basis.value[derivative][k];
    return sum;
}

std::vector<double> parameters(Curve const& curve) {
    std::vector<double> out;
    for (int k = 0; k <= 97; ++k)
        out.push_back(curve.begin() + (curve.end() - curve.begin()) * k / 97.0);
    for (int k = curve.degree; k <= curve.n_indices; ++k) out.push_back(curve.knots[k]);
    return out;
}

double const not_finite = std::numeric_limits<double>::quiet_NaN();

// Checks the refusal of a curve with the number 7: the words and, unless it is none, the second
// number of the sentence, which is that of a knot, an index, a control point or a degree.
Fault check_refusal(Spline const& spline, std::string const& words, Index number = none) {
    Fault fault;
    CHECK(check_curve(spline.curve(), 7, fault) == Status::bad_curve);
    INFO(fault.sentence);
    CHECK(std::string(fault.sentence).find(words) != std::string::npos);
    bool const begins_with_curve = std::string(fault.sentence).rfind("curve #", 0) == 0;
    CHECK((begins_with_curve ? fault.item.number : fault.other.number) == 7);
    if (number != none)
        CHECK((begins_with_curve ? fault.other.number : fault.item.number) == number);
    return fault;
}

}  // namespace

TEST_CASE("B-spline basis functions are not negative, sum up to 1, and their derivatives to 0") {
    for (int degree = 1; degree <= 5; ++degree)
        for (Spline const& spline :
             {fixtures::clamped(degree, 11, 1), with_weights(fixtures::clamped(degree, 9, 2)),
              fixtures::periodic(degree, 8, 1, 3)}) {
            Curve const curve = spline.curve();
            Fault fault;
            REQUIRE(check_curve(curve, 0, fault) == Status::ok);
            for (double const u : parameters(curve)) {
                CurveBasis const basis = curve_basis(curve, u, max_degree);
                CHECK(basis.order == degree + 1);
                for (int k = 0; k < basis.order; ++k) CHECK(basis.value[0][k] >= 0);
                CHECK(value_sum(basis, 0) == doctest::Approx(1).epsilon(1e-14));
                for (int d = 1; d <= max_degree; ++d) {
                    double size = 1;
                    for (int k = 0; k < basis.order; ++k) size += std::fabs(basis.value[d][k]);
                    CHECK(std::fabs(value_sum(basis, d)) <= 1e-12 * size);
                }
            }
        }
}

TEST_CASE("a clamped curve ends exactly at its control point") {
    for (int degree = 1; degree <= 5; ++degree)
        for (Spline const& spline :
             {fixtures::clamped(degree, 9, 4), with_weights(fixtures::clamped(degree, 9, 5))}) {
            Curve const curve = spline.curve();
            CurveBasis const first = curve_basis(curve, curve.begin(), 0);
            CurveBasis const last = curve_basis(curve, curve.end(), 0);
            CHECK(first.control[0] == 0);
            CHECK(first.value[0][0] == 1);
            CHECK(last.control[degree] == 8);
            CHECK(last.value[0][degree] == 1);
            CHECK(curve_point(curve, curve.end()).x == spline.control[16]);
            CHECK(curve_point(curve, curve.end()).y == spline.control[17]);
            CHECK((curve_point(curve, curve.end() + 1).x ==
                   spline.control[16]));  // outside: the nearer end
        }
}

TEST_CASE("derivatives of curves agree with central differences") {
    double const step = 1e-5;
    for (int degree = 2; degree <= 5; ++degree)
        for (Spline const& spline :
             {fixtures::clamped(degree, 10, 6), with_weights(fixtures::clamped(degree, 10, 7))}) {
            Curve const curve = spline.curve();
            for (int span = degree; span < curve.n_indices; ++span) {
                double const u = 0.5 * (curve.knots[span] + curve.knots[span + 1]);
                Vec2 here[max_order], before[max_order], after[max_order];
                curve_point(curve, u, 5, here);
                curve_point(curve, u - step, 5, before);
                curve_point(curve, u + step, 5, after);
                for (int d = 0; d < degree; ++d) {
                    Vec2 const difference = (0.5 / step) * (after[d] - before[d]);
                    CHECK(length(difference - here[d + 1]) <= 1e-6 * (1 + length(here[d + 1])));
                }
            }
        }
}

TEST_CASE("without inner knots the curve is the Bezier curve") {
    Spline spline;
    spline.degree = 3;
    spline.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    spline.control = {0, 0, 1, 2, 3, -1, 4, 1};
    for (int k = 0; k <= 10; ++k) {
        double const u = k / 10.0, v = 1 - u;
        CurveBasis const basis = curve_basis(spline.curve(), u, 1);
        double const exact[] = {v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u};
        double const slope[] = {-3 * v * v, 3 * v * v - 6 * u * v, 6 * u * v - 3 * u * u,
                                3 * u * u};
        for (int i = 0; i < 4; ++i) {
            CHECK(basis.value[0][i] == doctest::Approx(exact[i]).epsilon(1e-15));
            CHECK(std::fabs(basis.value[1][i] - slope[i]) < 1e-14);
        }
    }
}

TEST_CASE("a rational quadratic curve is a circle") {
    Spline const circle = fixtures::exact_circle(1, 0, 0);  // The NURBS Book, example 7.1
    Fault fault;
    REQUIRE(check_curve(circle.curve(), 0, fault) == Status::ok);
    for (int k = 0; k <= 400; ++k) {
        Vec2 c[3];
        curve_point(circle.curve(), k / 100.0, 2, c);
        CHECK(length(c[0]) == doctest::Approx(1).epsilon(1e-15));
        CHECK(std::fabs(dot(c[0], c[1])) < 1e-14);                      // the tangent
        CHECK(std::fabs(dot(c[0], c[2]) + square(c[1])) < 1e-13 * 10);  // d/du of that
    }
}

TEST_CASE("a knot of multiplicity m leaves degree - m continuous derivatives") {
    for (int degree = 2; degree <= 5; ++degree)
        for (int fold = 1; fold <= degree; ++fold) {
            Spline spline = fixtures::clamped(degree, degree + 1 + fold, 8);
            for (int k = 0; k < fold; ++k) spline.knots[std::size_t(degree + 1 + k)] = 0.5;
            Curve const curve = spline.curve();
            Fault fault;
            REQUIRE(check_curve(curve, 0, fault) == Status::ok);
            Vec2 left[max_order], right[max_order];
            curve_point_in(curve, degree, 0.5, 5, left);
            curve_point_in(curve, degree + fold, 0.5, 5, right);
            for (int d = 0; d <= degree - fold; ++d)
                CHECK(length(right[d] - left[d]) <= 1e-11 * (1 + length(left[d])));
            CHECK(length(right[degree - fold + 1] - left[degree - fold + 1]) > 1e-3);
            CHECK(knot_span(curve, 0.5) == degree + fold);
        }
}

TEST_CASE("a periodic curve is smooth at its seam") {
    for (int degree = 1; degree <= 5; ++degree) {
        Spline const spline = fixtures::periodic(degree, 8, 0.5, 9);
        Curve const curve = spline.curve();
        Vec2 begin[max_order], end[max_order];
        curve_point(curve, curve.begin(), 5, begin);
        curve_point(curve, curve.end(), 5, end);
        for (int d = 0; d < degree; ++d)
            CHECK(length(end[d] - begin[d]) < 1e-12 * (1 + length(begin[d])));
    }
}

TEST_CASE("a curve that is not well formed is refused with the reason and the place") {
    Spline const good = fixtures::clamped(3, 8, 10);
    const char* const length = "has no length, or a knot is beyond 1e100";
    struct {
        const char* words;
        Index number;
        void (*spoil)(Spline&);
    } const cases[] = {
        {"has degree @, but the degree must be 1 to 5", 6, [](Spline& s) { s.degree = 6; }},
        {"more than its degree", none, [](Spline& s) { s.knots.resize(7); }},
        {"not finite", 5, [](Spline& s) { s.knots[5] = not_finite; }},
        {"is smaller than the knot before it", 6, [](Spline& s) { s.knots[6] = s.knots[5] - 0.1; }},
        {length, none, [](Spline& s) { s.knots.assign(12, 2); }},
        {length, none,  // too short for derivatives
         [](Spline& s) {
             for (double& knot : s.knots) knot *= 1e-104;
         }},
        {length, none,
         [](Spline& s) {
             for (double& knot : s.knots) knot *= 1e100;
         }},
        {"repeated", 7, [](Spline& s) { std::fill(&s.knots[4], &s.knots[8], 2.0); }},
        {"index #", 6, [](Spline& s) { s.indices = {0, 1, 2, 3, 4, 5, 8, 7}; }},
        {"index #", 6,
         [](Spline& s) {
             s.indices = {0, 1, 2, 3, 4, 5, std::numeric_limits<std::int32_t>::min(), 7};
         }},
        {"fewer", none, [](Spline& s) { s.control.resize(14); }},
        {"control point #", 4, [](Spline& s) { s.control[9] = not_finite; }},
    };
    for (auto const& one : cases) {
        Spline bad = good;
        one.spoil(bad);
        Fault const fault = check_refusal(bad, one.words, one.number);
        if (bad.indices.size() > 6 && bad.indices[6] != 6) CHECK(fault.value == bad.indices[6]);
        if (one.number == 4) CHECK(fault.item.kind == ItemKind::control_point);
    }
    Spline bad = good;
    for (double& knot : bad.knots) knot -= good.knots[6];
    bad.knots[7] = 1e-19;
    check_refusal(bad, "less than 1e-18", 7);
    bad.knots[7] = 1e-16;
    Fault fault;
    CHECK(check_curve(bad.curve(), 7, fault) == Status::ok);
    for (double const weight : {0.0, -1.0, 1e-11, 1e11, not_finite, HUGE_VAL}) {
        bad = with_weights(good);
        bad.weights[3] = weight;
        CHECK(check_refusal(bad, "weight", 3).item.kind == ItemKind::control_point);
    }
}
