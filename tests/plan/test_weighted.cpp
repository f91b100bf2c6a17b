// The weighted Laplace operator: k = 1 / d^q, d the distance to what moves.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/matrices.hpp>
#include <fixtures/operators.hpp>

using namespace fixtures;

namespace {

// The unknowns' matrix with given conductivities.
DenseMatrix assembled(Case& setup, std::vector<double> const& k) {
    Analysed const seen(setup);
    AssembledMatrix matrix(*seen.operator->());
    REQUIRE(assemble_stiffness(seen->topology(), seen->problem().mesh.points, span(k), false,
                               matrix.matrix, {}) == harmorph::none);
    return matrix.unknowns();
}

// All functions are moved by 1 on a ring of radius r0 and 0 on r1: only r matters, r k f' is
// constant, and f = I(r) / I(r0), I(r) = integral from r to r1 of (s - r0)^q / s ds, by the
// midpoint rule.
double radial(double r, double r0, double r1, double q) {
    auto const integral = [&](double from) {
        constexpr int steps = 2000;
        double sum = 0;
        for (int k = 0; k < steps; ++k) {
            double const s = from + (r1 - from) * (k + 0.5) / steps;
            sum += std::pow(s - r0, q) / s;
        }
        return sum * (r1 - from) / steps;
    };
    return r >= r1 ? 0 : integral(r) / integral(r0);
}

double rms_error(int refine, Cells kind, double exponent) {
    int const n_r = 8 * refine, n_t = 32 * refine;
    Case setup = ring_case(n_r, n_t, 0.5, 2, kind);
    Options const options = options_of(HM_WEIGHTED, exponent);
    Solved const solved(setup, &options);
    std::vector<double> const sum = solved.sum();
    double sum_of_squares = 0;
    for (int i = 0; i <= n_r; ++i) {
        double const exact = radial(0.5 * std::pow(4, 1.0 * i / n_r), 0.5, 2, exponent);
        for (int k = 0; k < n_t; ++k)
            sum_of_squares += std::pow(sum[std::size_t(i * n_t + k)] - exact, 2);
    }
    return std::sqrt(sum_of_squares / double(sum.size()));
}

}  // namespace

TEST_CASE("annulus: the exact radial solution, to second order, for exponents of all kinds") {
    for (Cells const kind : {Cells::quads, Cells::hybrid, Cells::triangles})
        for (double const exponent : {0.25, 0.5, 1.0, 1.75, 2.0}) {
            double const coarse = rms_error(2, kind, exponent), fine = rms_error(4, kind, exponent);
            INFO("q = " << exponent << ": " << coarse << " " << fine);
            CHECK(fine < 1e-3);
            // A ring's quads have equal diagonals: which one splits them is chance, and part of the
            // error is, too.
            double const at_best = kind == Cells::quads ? 1.85 : 1.5;
            // F = d^(1 + q): less smooth.
            CHECK(std::log2(coarse / fine) > (exponent < 1 ? 1 + 0.8 * exponent : at_best));
        }
}

TEST_CASE("a constant factor of k is a factor of the matrix: it changes no function") {
    Case setup = square_on_curve(7, Cells::hybrid, 0.4, 3);
    std::mt19937 random(4);
    std::vector<double> k, eightfold;
    for (std::int32_t i = 0; i < setup.mesh.n_cells(); ++i) {
        k.push_back(0.1 + uniform(random));
        eightfold.push_back(8 * k.back());
    }
    DenseMatrix const a = assembled(setup, k), b = assembled(setup, eightfold);
    std::vector<double> expected;
    for (double const entry : a.entries) expected.push_back(8 * entry);
    CHECK(same_bits(b.entries, expected));
    CHECK(same_bits(assembled(setup, {}).entries,
                    assembled(setup, std::vector<double>(k.size(), 1.0)).entries));
    CHECK(!same_bits(a.entries, assembled(setup, {}).entries));
}

TEST_CASE("nor does the unit of length, though k has one") {
    Case const origin = airfoil_case(30, 10);
    for (double const exponent : {0.25, 1.0, 1.5, 4.0}) {
        Options const options = options_of(HM_WEIGHTED, exponent);
        Case setup = origin;
        Solved const reference(setup, &options);
        for (double const unit : {1 / 1024.0, 3.7, 1e20}) {
            Case scaled = similar(origin, unit, 0);
            CHECK(largest_difference(Solved(scaled, &options).all_values(),
                                     reference.all_values()) < 1e-9);
        }
    }
}

TEST_CASE("without a weight: Laplace's functions, bit by bit; the larger q, the more moves along") {
    Case setup = airfoil_case();
    Options const none_at_all = options_of(HM_WEIGHTED, -1), usual = options_of(HM_WEIGHTED);
    Solved const plain(setup), unweighted(setup, &none_at_all), by_default(setup, &usual);
    CHECK(same_bits(unweighted.all_values(), plain.all_values()));
    CHECK(by_default.info().exponent == 1);
    std::vector<double> last = plain.sum();
    for (double const exponent : {0.5, 1.0, 1.5, 2.0}) {
        Options const options = options_of(HM_WEIGHTED, exponent);
        Solved const solved(setup, &options);
        CHECK(solved.info().exponent == exponent);
        if (exponent == 1) CHECK(same_bits(solved.all_values(), by_default.all_values()));
        std::vector<double> const sum = solved.sum();
        double mean = 0;
        for (std::size_t k = 0; k < sum.size(); ++k)
            mean += (sum[k] - last[k]) / double(sum.size());
        CHECK(mean > 0.01);
        last = sum;
    }
}

TEST_CASE("a plan without a weight is smaller by one number for each cell") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = ring_case(8, 32, 0.5, 2, kind);
        Options const weighted = options_of(HM_WEIGHTED, 1),
                      none_at_all = options_of(HM_WEIGHTED, -1);
        Solved const with(setup, &weighted), without(setup, &none_at_all), laplace(setup);
        std::size_t const more = with.plan_block->size() - without.plan_block->size();
        CHECK(more ==
              8 * std::size_t(setup.mesh.n_cells()));  // a multiple of the alignment of arrays
        CHECK(without.plan_block->size() == laplace.plan_block->size());
    }
}

TEST_CASE("rigid bodies count for the distance as curves do, fixed boundaries do not") {
    Case curve = ring_case(8, 32, 0.5, 2);
    Case rigid = curve, shifted = curve;
    rigid.conditions.clear();
    rigid.curves = CurveSet{};
    rigid.known_points.clear();
    rigid.set_rigid(body, 0, 0);
    hm_problem problem = rigid.problem();
    problem.curves = nullptr;
    problem.n_known = 0;
    Options const options = options_of(HM_WEIGHTED, 1.5);
    Solved const a(curve, &options), b(problem, &options);
    // A translation of all: the same data on the wall, so the same displacements if the weights are
    // the same.
    Field const by_curve = displacement(a, similarity_move(curve.curves, 1, 0, {1, -2}));
    CHECK(largest_difference(by_curve, displacement(b, {1, -2, 0, 0})) < 1e-13);
    // If the far field is on a curve, too, distances and functions differ.
    shifted.curves.add(ring(3, 8, 2, 2));
    shifted.put_on_curves(far_field, 1);
    Solved const c(shifted, &options);
    CHECK(largest_difference(c.values(0), a.values(0)) > 1e-3);
}
