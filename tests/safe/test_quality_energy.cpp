// The energy of a corner relative to its target: derivatives against differences, where it is
// smallest, and the quality it is a power of.
#include <doctest/doctest.h>

#include <fixtures/quality_energy.hpp>

#include "morph/quality.hpp"
#include "safe/cell_form.hpp"

#include <cmath>
#include <random>
#include <vector>

using fixtures::QualityEnergy;
using harmorph::Index;
using harmorph::Triangle;
using harmorph::Vec2;

namespace {

double random_number(std::mt19937& random) { return double(random()) / 2147483648.0 - 1; }

Triangle random_triangle(std::mt19937& random) {
    Triangle out;
    do {
        for (Vec2& point : out.at) point = {random_number(random), random_number(random)};
    } while (out.twice_area() < 0.2);
    return out;
}

double& coordinate(Triangle& triangle, int k) {
    return k % 2 == 0 ? triangle.at[k / 2].x : triangle.at[k / 2].y;
}
double component(Vec2 v, int k) { return k % 2 == 0 ? v.x : v.y; }

struct Derivatives {
    harmorph::CellForm<3> form;

    Derivatives(QualityEnergy const& energy, Triangle const& now, double weight, double least) {
        harmorph::CornerForm corner;
        energy.differentiate(now, weight, least, corner);
        form.add(0, 1, 2, corner);
    }
    double gradient(int i) const { return component(form.by[i / 2], i); }
    double hessian(int i, int j) const {
        harmorph::Block const& block = form.hessian[i / 2][j / 2];
        return i % 2 == 0 ? component({block.a, block.b}, j) : component({block.c, block.d}, j);
    }
};

constexpr double exact =
    -1e150;  // no curvature is raised; times any energy in the range of numbers

}  // namespace

TEST_CASE("the gradient is that of the quality energy; the exact Hessian that of the gradient") {
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        Triangle const target = random_triangle(random), now = random_triangle(random);
        Index const power = 1 + trial % 4;
        double const weight = 0.3 + 0.2 * (trial % 5), h = 1e-6;
        QualityEnergy const energy{target, power, 0.7, trial % 2 == 1};
        Derivatives const here(energy, now, weight, exact);
        double slopes = 0, bends = 0;
        for (int i = 0; i < 6; ++i) {
            slopes = std::fmax(slopes, std::fabs(here.gradient(i)));
            for (int j = 0; j < 6; ++j) bends = std::fmax(bends, std::fabs(here.hessian(i, j)));
        }
        for (int i = 0; i < 6; ++i) {
            Triangle ahead = now, behind = now;
            coordinate(ahead, i) += h;
            coordinate(behind, i) -= h;
            double const rise = weight * (energy.energy(ahead) - energy.energy(behind));
            CHECK(std::fabs(here.gradient(i) - rise / (2 * h)) < 1e-6 * (slopes + bends));
            if (energy.any_ratio) continue;  // the Hessian is that of the present ratio
            Derivatives const after(energy, ahead, weight, exact),
                before(energy, behind, weight, exact);
            for (int j = 0; j < 6; ++j) {
                double const bend = (after.gradient(j) - before.gradient(j)) / (2 * h);
                CHECK(std::fabs(here.hessian(i, j) - bend) < 1e-5 * bends);
            }
        }
    }
}

// The Hessian by the coordinates of the two sides.
struct BySides {
    double value[4][4];

    explicit BySides(harmorph::CornerForm const& form) {
        harmorph::Block const blocks[2][2] = {{form.side_side, form.side_next},
                                              {transpose(form.side_next), form.next_next}};
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                harmorph::Block const& block = blocks[i / 2][j / 2];
                value[i][j] = i % 2 == 0 ? component({block.a, block.b}, j)
                                         : component({block.c, block.d}, j);
            }
    }
};

TEST_CASE("curvatures of the quality energy are raised to 4 power energy and never lowered") {
    // With the unit square's corner as target, derivatives by the sides are half of those by z and
    // w. Raising eigenvalues of the matrix H to f gives R with (R - f) (R - H) = 0 and R >= f.
    std::mt19937 random(2);
    int raised = 0;
    for (int trial = 0; trial < 100; ++trial) {
        Triangle const now = random_triangle(random);
        Index const power = 1 + trial % 3;
        QualityEnergy const energy{{{{-1, 0}, {0, 0}, {0, 1}}}, power};
        harmorph::CornerForm free, convex;
        energy.differentiate(now, 1, exact, free);
        energy.differentiate(now, 1, 0.25, convex);
        BySides const h(free), r(convex);
        double const floor = 0.5 * 0.25 * 4 * power * energy.energy(now);
        double largest = 0, changed = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                largest = std::fmax(largest, std::fabs(r.value[i][j]));
                changed = std::fmax(changed, std::fabs(r.value[i][j] - h.value[i][j]));
            }
        raised += changed > 1e-6 * largest;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                double product = 0;
                for (int k = 0; k < 4; ++k)
                    product +=
                        (r.value[i][k] - (i == k ? floor : 0)) * (r.value[k][j] - h.value[k][j]);
                CHECK(std::fabs(product) < 1e-11 * largest * largest);
            }
        for (int sample = 0; sample < 20; ++sample) {
            double v[4], of_r = 0, of_h = 0, size = 0;
            for (double& x : v) x = random_number(random);
            for (int i = 0; i < 4; ++i) {
                size += v[i] * v[i];
                for (int j = 0; j < 4; ++j) {
                    of_r += v[i] * r.value[i][j] * v[j];
                    of_h += v[i] * h.value[i][j] * v[j];
                }
            }
            CHECK(of_r > floor * size - 1e-11 * largest);
            CHECK(of_r > of_h - 1e-11 * largest);
        }
    }
    CHECK(raised > 20);
}

TEST_CASE("all corners of a list have the numbers of each alone, in every place of a register") {
    std::mt19937 random(5);
    for (Index n = 1; n <= harmorph::CornerList::max_count; n += n < 9 ? 1 : 7) {
        std::vector<Triangle> now, target;
        harmorph::CornerList list;
        list.power = 4;
        for (Index k = 0; k < n; ++k) {
            now.push_back(random_triangle(random));
            target.push_back(random_triangle(random));
            if (k % 5 == 3) std::swap(now.back().at[0], now.back().at[2]);  // inverted
            list.add(now.back(), target.back(), k % 3 == 0, 0.5 * k, 0.9);
        }
        double each[harmorph::CornerList::max_count], sum = 0;
        harmorph::QualityKernels const& kernels =
            harmorph::quality_kernels(harmorph::best_kernel());
        double const found = kernels.energies(list, each);
        for (Index k = 0; k < n; ++k) {
            QualityEnergy const energy{target[std::size_t(k)], 4, 0.9, k % 3 == 0};
            CHECK(each[k] == energy.energy(now[std::size_t(k)], 0.5 * k));
            sum += each[k];
        }
        CHECK(found == sum);
    }
}

TEST_CASE("the quality energy is 1 at the turned target and infinite when inverted") {
    std::mt19937 random(3);
    for (int trial = 0; trial < 50; ++trial) {
        Triangle const target = random_triangle(random);
        QualityEnergy const energy{target};
        double const c = std::cos(1.0 * trial), s = std::sin(1.0 * trial);
        Triangle now;
        for (int k = 0; k < 3; ++k) {
            Vec2 const p = target.at[k];
            now.at[k] = {c * p.x - s * p.y + 5, s * p.x + c * p.y - 3};
        }
        for (Index const power : {1, 2, 4, 8}) {
            CHECK(QualityEnergy{target, power}.energy(now) == doctest::Approx(1).epsilon(1e-12));
            Derivatives const here(QualityEnergy{target, power}, now, 1, exact);
            for (int k = 0; k < 6; ++k) CHECK(std::fabs(here.gradient(k)) < 1e-10);
        }
        for (int k = 0; k < 20; ++k) {
            Triangle const other = random_triangle(random);
            double const value = energy.energy(other);
            CHECK(value >= 1 - 1e-12);
            double const of_power = QualityEnergy{target, 4, 0.25}.energy(other);
            CHECK(of_power == doctest::Approx(std::pow(0.25 * value, 4)).epsilon(1e-12));
        }
        std::swap(now.at[0], now.at[2]);
        CHECK(energy.energy(now) == HUGE_VAL);
        now.at[0] = now.at[1];
        CHECK(energy.energy(now) == HUGE_VAL);
    }
}

TEST_CASE("the quality energy with an equilateral target is the quality to the power of -2") {
    std::mt19937 random(4);
    for (int trial = 0; trial < 50; ++trial) {
        Triangle const now = random_triangle(random);
        double const height = std::sqrt(0.75), side = std::sqrt(now.twice_area() / height);
        QualityEnergy const energy{{{{0, 0}, {side, 0}, {0.5 * side, height * side}}}};
        double const x[] = {now.at[0].x, now.at[1].x, now.at[2].x},
                     y[] = {now.at[0].y, now.at[1].y, now.at[2].y};
        harmorph::CellShape const shape(harmorph::Cell{3, {0, 1, 2}}, {x, y, 1}, false);
        double const quality = harmorph::skew_quality(3, harmorph::CellCorners(shape));
        CHECK(energy.energy(now) == doctest::Approx(1 / (quality * quality)).epsilon(1e-12));
    }
}

TEST_CASE("derivatives of the quality energy are finite where the energy is") {
    int finite = 0, infinite = 0;
    for (double const size : {1e-95, 1e-40, 1.0, 1e40, 1e95})
        for (int flat = 0; flat < 80; flat += 3)
            for (double const grown : {1e-30, 1.0, 1e30})
                for (Index const power : {1, 2, 8, 32}) {
                    double const height = std::pow(10.0, -flat);
                    Triangle const target{{{0, 0}, {size, 0}, {size, size}}};
                    Triangle const now{
                        {{0, 0}, {grown * size, 0}, {grown * size, grown * height * size}}};
                    QualityEnergy const energy{target, power};
                    if (energy.energy(now) == HUGE_VAL) {
                        ++infinite;
                    } else {
                        ++finite;
                        Derivatives const by(energy, now, 1, 0.02);
                        for (int i = 0; i < 6; ++i) {
                            CHECK(std::isfinite(by.gradient(i)));
                            for (int j = 0; j < 6; ++j) CHECK(std::isfinite(by.hessian(i, j)));
                        }
                    }
                }
    CHECK(finite > 200);
    CHECK(infinite > 200);
}
