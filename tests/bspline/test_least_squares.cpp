#include <doctest/doctest.h>

#include "bspline/least_squares.hpp"

#include <fixtures/spline.hpp>
#include <fixtures/guarded.hpp>

using namespace harmorph;
using fixtures::Spline;

namespace {

struct Problem {
    std::unique_ptr<fixtures::Guarded> block;
    std::vector<Vec2> points;
    LeastSquares squares;

    // Points of the curve at evenly spread parameters, ends included.
    Problem(Spline const& spline, int n) {
        Curve const curve = spline.curve();
        block = fixtures::laid_out_part(squares, n, curve.n_control, curve.degree);
        points.resize(std::size_t(n));
        squares.set_up(curve, {points.data(), points.size()});
        for (int k = 0; k < n; ++k) {
            squares.u[k] = curve.begin() + (curve.end() - curve.begin()) * k / (n - 1.0);
            squares.weight[k] = 1.0 / n;
            points[std::size_t(k)] = curve_point(curve, squares.u[k]);
        }
        fill(squares.pinned, none);
        squares.start();
    }
    double largest_difference(std::vector<double> const& control) const {
        double out = 0;
        for (std::size_t k = 0; k < control.size(); ++k)
            out = std::fmax(out, std::fabs(squares.control[k] - control[k]));
        return out;
    }
};

}  // namespace

TEST_CASE("the least squares of points of a B-spline return its control points") {
    for (int degree = 1; degree <= 5; ++degree)
        for (Spline const& spline :
             {fixtures::clamped(degree, 12, 1), fixtures::periodic(degree, 10, 0.5, 2)}) {
            Problem problem(spline, 80);
            problem.squares.solve(0.02);
            CHECK(problem.largest_difference(spline.control) < 1e-9);
            CHECK(problem.squares.correct_parameters() < 1e-9);
        }
}

TEST_CASE("pinned control points stay, and the others minimise the rest") {
    Spline const spline = fixtures::clamped(3, 10, 3);
    Problem problem(spline, 60);
    problem.points.front() = problem.points.front() + Vec2{0, 0.1};
    problem.squares.pinned[0] = 0;
    problem.squares.pinned[9] = 59;
    problem.squares.solve(0.02);
    Span<const Real> const control = problem.squares.control;
    CHECK(control[0] == problem.points.front().x);
    CHECK(control[1] == problem.points.front().y);
    CHECK(control[18] == problem.points.back().x);
    CHECK(control[19] == problem.points.back().y);
    CHECK(problem.squares.correct_parameters() > 1e-3);
    CHECK(problem.squares.error[0] == 0);
    CHECK(problem.squares.error[40] < 1e-3);
}

TEST_CASE("control points that no point determines are smooth, and straight lines stay straight") {
    Spline line = fixtures::clamped(3, 12, 4);
    for (int k = 0; k < 12; ++k) {
        double greville = 0;
        for (int j = 1; j <= 3; ++j) greville += line.knots[std::size_t(k + j)] / 3;
        line.control[std::size_t(2 * k)] = 1 + greville;
        line.control[std::size_t(2 * k + 1)] = 2 - 3 * greville;
    }
    Problem problem(line, 50);
    for (Index k = 15; k < 35; ++k) problem.squares.weight[k] = 0;
    problem.squares.solve(0.02);
    CHECK(problem.largest_difference(line.control) < 1e-3);
    for (Index k = 0; k < 50; ++k)
        CHECK(length(curve_point(problem.squares.curve, problem.squares.u[k]) -
                     problem.squares.points[k]) < 1e-3);
}

TEST_CASE("parameters are corrected towards the feet and stay in order") {
    Spline const spline = fixtures::periodic(3, 12, 0.6, 5);
    Problem problem(spline, 60);
    std::vector<double> exact(problem.squares.u.begin(), problem.squares.u.end());
    for (Index k = 1; k < 59; ++k) problem.squares.u[k] += k % 2 == 0 ? 0.04 : -0.04;
    copy(problem.squares.control, Span<const Real>(spline.control.data(), spline.control.size()));
    for (int times = 0; times < 4; ++times) problem.squares.correct_parameters();
    for (Index k = 1; k < 59; ++k)
        CHECK(problem.squares.u[k] == doctest::Approx(exact[std::size_t(k)]).epsilon(1e-10));
    for (Index k = 1; k < 59; ++k) problem.squares.u[k] += k % 2 == 0 ? 0.1 : -0.1;  // nearly met
    problem.squares.correct_parameters();
    for (Index k = 1; k < 60; ++k) CHECK(problem.squares.u[k] > problem.squares.u[k - 1]);
}

TEST_CASE("solving and correcting in turn finds the parameters, too") {
    for (int degree = 2; degree <= 3; ++degree) {
        Spline const spline = fixtures::clamped(degree, degree + 1, 1);
        Problem problem(spline, 60);
        double travelled = 0;
        std::vector<double> arc{0};
        for (std::size_t k = 1; k < 60; ++k)
            arc.push_back(travelled += length(problem.points[k] - problem.points[k - 1]));
        for (Index k = 0; k < 60; ++k) problem.squares.u[k] = arc[std::size_t(k)] / travelled;
        problem.squares.pinned[0] = 0;
        problem.squares.pinned[degree] = 59;
        double error = 1;
        for (int times = 0; times < 40; ++times) {
            problem.squares.solve(0.02);
            error = problem.squares.correct_parameters();
        }
        CHECK(error < 1e-6);
        CHECK(problem.largest_difference(spline.control) < 1e-5);
    }
}
