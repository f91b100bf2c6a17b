// Minus the logarithm of the quality of a cell: derivatives against differences, and Hessians that
// are positive definite. Covers small_eigen.hpp, too.
#include <doctest/doctest.h>

#include "safe/cell_logarithm.hpp"
#include "safe/small_eigen.hpp"

#include <cmath>
#include <random>

using harmorph::CellCorners;
using harmorph::CellForm;
using harmorph::CellMeasure;
using harmorph::CellShape;
using harmorph::Index;
using harmorph::LogarithmWeights;
using harmorph::Vec2;

namespace {

double random_number(std::mt19937& random) { return double(random()) / 2147483648.0 - 1; }

template <Index n>
struct SomeCell {
    CellShape shape;

    // The corners of a regular cell, moved by up to `part` of the distance, in a frame that is
    // `thin` times as high as long.
    SomeCell(std::mt19937& random, double part, double thin)
        : shape({n, {0, 1, 2, 3}}, {&zero[0].x, &zero[0].y, 2}, false) {
        for (Index k = 0; k < n; ++k) {
            double const angle = 6.283185307179586 * k / n;
            shape.at[k] = {std::cos(angle) + part * random_number(random),
                           thin * (std::sin(angle) + part * random_number(random))};
        }
        close();
    }
    void close() {
        if (n == 3) shape.at[3] = shape.at[0];
    }
    double y(double area, double blur) const {
        return harmorph::minus_log_quality(CellMeasure(n, CellCorners(shape)), area, blur);
    }
    double moved(Index number, double by, double area, double blur) const {
        SomeCell other = *this;
        Vec2& at = other.shape.at[number / 2];
        (number % 2 == 0 ? at.x : at.y) += by;
        other.close();
        return other.y(area, blur);
    }

    static constexpr Vec2 zero[4] = {};
};

template <Index n>
double product(CellForm<n> const& form, Vec2 const (&v)[n]) {
    double sum = 0;
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < n; ++j) sum += dot(v[i], form.hessian[i][j] * v[j]);
    }
    return sum;
}

template <Index n>
void check_gradient() {
    std::mt19937 random(5);
    for (double const thin : {1.0, 0.03}) {
        for (double const area : {0.3, 2.0}) {
            SomeCell<n> const cell(random, 0.2, thin);
            CellForm<n> form;
            differentiate_cell(cell.shape, area, LogarithmWeights{1, 0, 0.1, 0, 0.2}, form);
            for (Index k = 0; k < 2 * n; ++k) {
                double const h = 1e-6 * thin;
                double const slope =
                    (cell.moved(k, h, area, 0.2) - cell.moved(k, -h, area, 0.2)) / (2 * h);
                double const found = k % 2 == 0 ? form.by[k / 2].x : form.by[k / 2].y;
                CHECK(found == doctest::Approx(slope).epsilon(1e-6).scale(1 / thin));
            }
        }
    }
}

// Where a curvature of the energy outweighs all others, the Hessian is the true one.
template <Index n>
void check_hessian() {
    std::mt19937 random(6);
    double const blur = 4;
    SomeCell<n> cell(random, 0, 1);
    CellForm<n> form;
    differentiate_cell(cell.shape, CellCorners(cell.shape).cell_area(n),
                       LogarithmWeights{1, 0, 0, 0, blur}, form);
    double const own = CellCorners(cell.shape).cell_area(n), h = 1e-4;
    for (int trial = 0; trial < 20; ++trial) {
        Vec2 v[n];
        for (Vec2& at : v) at = {random_number(random), random_number(random)};
        auto const along = [&](double by) {
            SomeCell<n> other = cell;
            for (Index k = 0; k < n; ++k) other.shape.at[k] = other.shape.at[k] + by * v[k];
            other.close();
            return other.y(own, blur);
        };
        double const bend = (along(h) - 2 * along(0) + along(-h)) / (h * h);
        CHECK(product(form, v) == doctest::Approx(bend).epsilon(1e-4));
    }
}

template <Index n>
void check_positive() {
    std::mt19937 random(7);
    for (int trial = 0; trial < 50; ++trial) {
        SomeCell<n> const cell(random, 0.25, trial % 2 == 0 ? 1 : 1e-3);
        CellForm<n> form;
        differentiate_cell(cell.shape, 0.5, LogarithmWeights{0.3, trial * 0.1, 0.01, 0.02, 0.1},
                           form);
        Vec2 v[n], translation[n];
        for (Index k = 0; k < n; ++k) {
            v[k] = {random_number(random), random_number(random)};
            translation[k] = {0.3, -0.7};
        }
        CHECK(product(form, v) > 0);
        // All points together move freely.
        CHECK(std::fabs(product(form, translation)) < 1e-9 * form.hessian[0][0].d);
        for (Index i = 0; i < n; ++i) {
            for (Index j = 0; j < n; ++j)
                CHECK(form.hessian[i][j].b ==
                      doctest::Approx(form.hessian[j][i].c).scale(form.hessian[0][0].d));
        }
    }
}

}  // namespace

TEST_CASE("the gradient of the logarithm is that of differences, for thin cells too") {
    check_gradient<3>();
    check_gradient<4>();
}

TEST_CASE("the Hessian of a regular cell is that of differences") {
    check_hessian<3>();
    check_hessian<4>();
}

TEST_CASE("the Hessian of any cell is symmetric and positive definite but for translations") {
    check_positive<3>();
    check_positive<4>();
}

TEST_CASE("the logarithm is that of the reported quality, and inverted cells have infinity") {
    std::mt19937 random(8);
    SomeCell<4> cell(random, 0.2, 0.3);
    CellMeasure const measure(4, CellCorners(cell.shape));
    for (double const area : {0.1, 0.4, 3.0})
        CHECK(std::exp(-cell.y(area, 0)) == doctest::Approx(measure.quality(area)).epsilon(1e-12));
    std::swap(cell.shape.at[0], cell.shape.at[1]);
    CHECK(cell.y(1, 0) == harmorph::infinity);
}

TEST_CASE("a symmetric matrix is the sum over its eigenvectors") {
    std::mt19937 random(9);
    for (int trial = 0; trial < 20; ++trial) {
        double a[6][6], given[6][6], vector[6][6];
        for (int i = 0; i < 6; ++i) {
            for (int j = i; j < 6; ++j)
                a[i][j] = given[i][j] = given[j][i] =
                    trial % 3 == 0 && i != j ? 0 : random_number(random);
        }
        harmorph::diagonalise(a, vector);
        for (int i = 0; i < 6; ++i) {
            for (int j = 0; j < 6; ++j) {
                double sum = 0, unit = 0;
                for (int k = 0; k < 6; ++k) {
                    sum += a[k][k] * vector[i][k] * vector[j][k];
                    unit += vector[k][i] * vector[k][j];
                }
                CHECK(sum == doctest::Approx(given[i][j]).epsilon(1e-12).scale(1));
                CHECK(unit == doctest::Approx(i == j ? 1 : 0).epsilon(1e-12).scale(1));
            }
        }
    }
}
