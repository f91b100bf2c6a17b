// A factor in single precision, and functions refined to what double precision gives.
#include <harmorph_study.h>
#include "fixtures/options.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;

namespace {

Options with(std::int32_t operator_kind, std::int32_t precision) {
    Options out{};
    out.operator_kind = operator_kind;
    out.precision = precision;
    return out;
}

struct Difference {
    double worst = 0, largest = 0;  // largest: of the values themselves
};

Difference difference_of_all(Solved const& a, Attempt const& b) {
    Difference out;
    hm_basis_info const info = a.info();
    for (std::int32_t function = 0; function < info.functions; ++function)
        for (std::int32_t number = 0; number < info.numbers_per_value; ++number) {
            std::vector<double> const p = values_of(a.basis, function, number),
                                      q = values_of(b.basis, function, number);
            out.worst = std::fmax(out.worst, largest_difference(p, q));
            for (double const value : p) out.largest = std::fmax(out.largest, std::fabs(value));
        }
    return out;
}

// The functions are those of double precision.
void check_same(Case& setup, std::int32_t operator_kind, double tolerance) {
    Options const in_double = with(operator_kind, HM_DOUBLE),
                  in_single = with(operator_kind, HM_SINGLE);
    Solved const exact(setup, &in_double), refined(setup, &in_single);
    INFO("operator " << operator_kind << ": " << refined.report.refinements << " steps to "
                     << refined.report.residual);
    CHECK(refined.report.residual < 1e-12);
    CHECK(refined.report.refinements >= 1);
    CHECK(refined.report.refinements <= 4);
    CHECK(difference_of_all(exact, refined).worst < tolerance);
    CHECK(refined.report.boundary_error < 1e-15);
}

}  // namespace

TEST_CASE("real, complex and weighted functions, more of them than are refined at a time") {
    for (int const n_control : {5, 31})
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL, HM_WEIGHTED}) {
            Case setup = ring_case(14, 62, 0.5, 2, Cells::hybrid, 3, n_control);
            check_same(setup, operator_kind, 1e-11);
        }
}

TEST_CASE("viscous meshes: entries of the matrix that differ by eight orders") {
    Case setup = airfoil_case();
    HybridOptions options;
    options.first = 1e-5;
    options.layers = 25;
    setup.mesh = hybrid_mesh(naca4(Naca4{}, 60), options);
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL})
        check_same(setup, operator_kind, 1e-9);
}

TEST_CASE("the thinner cells are, the more steps; where they are too thin the factor is refused") {
    int done = 0, refused = 0;
    for (double const first : {1e-2, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9})
        for (std::int32_t const operator_kind : {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL})
            for (double const exponent : {0, 4}) {
                if (operator_kind == HM_LAPLACE && exponent > 0) continue;
                Case setup = airfoil_case(40, 12, Cells::quads);
                setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(first, 60, 40)).mesh;
                Options in_double = with(operator_kind, HM_DOUBLE),
                        in_single = with(operator_kind, HM_SINGLE);
                in_double.exponent = in_single.exponent = exponent;
                Solved const exact(setup, &in_double);
                Attempt const attempt(setup.problem(), &in_single);
                INFO("first cell " << first << ", operator " << operator_kind << ", exponent "
                                   << exponent << ": " << attempt.error.text << ", "
                                   << attempt.report.refinements << " steps");
                if (first > 5e-6) CHECK(attempt.status == HM_OK);
                if (attempt.status == HM_OK) {
                    Difference const found = difference_of_all(exact, attempt);
                    CHECK(found.worst < 1e-9 * found.largest);
                    ++done;
                } else {
                    // The entries of this matrix are beyond the numbers of single precision.
                    bool const beyond = attempt.status == HM_UNSUPPORTED;
                    if (!beyond) CHECK(attempt.status == HM_NOT_POSITIVE);
                    if (beyond) CHECK(exponent == 4);
                    ++refused;
                }
            }
    CHECK(done >= 30);
    CHECK(refused > 0);
}

TEST_CASE("a second correction as large as the first: rough right-hand sides, no stagnation") {
    Case setup = airfoil_case(40, 12, Cells::quads);
    setup.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-5, 60, 40)).mesh;
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL})
        check_same(setup, operator_kind, 1e-10);
}

TEST_CASE("the plan takes less than two thirds of the memory") {
    Case setup = ring_case(60, 300, 0.5, 2, Cells::quads, 3, 20);
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL}) {
        std::size_t bytes[2] = {};
        for (std::int32_t const precision : {HM_DOUBLE, HM_SINGLE}) {
            Options const options = with(operator_kind, precision);
            Solved const solved(setup, &options);
            bytes[precision] = solved.plan_block->size();
        }
        INFO(bytes[HM_DOUBLE] << " and " << bytes[HM_SINGLE] << " bytes");
        CHECK(3 * bytes[HM_SINGLE] < 2 * bytes[HM_DOUBLE]);
    }
}

// Weights are (unit / d)^4 at the most, and functions of bodies as large as the bodies.
TEST_CASE("entries and right-hand sides beyond single precision are refused by name") {
    Options options = with(HM_CONFORMAL, HM_SINGLE);
    options.exponent = 4;
    Case thin = airfoil_case(40, 12, Cells::quads);
    thin.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-9, 60, 40)).mesh;
    Attempt const entries(thin.problem(), &options);
    CHECK(entries.status == HM_UNSUPPORTED);
    CHECK(std::string(entries.error.text).find("the matrix has the diagonal entry") == 0);
    CHECK(entries.error.value > 1e36);

    Case body = airfoil_case(40, 12, Cells::quads);
    body.mesh = c_mesh(naca4({}, 30), 18, 40, stretched(1e-5, 60, 40)).mesh;
    body.conditions.clear();
    body.curves = {};
    body = similar(body, 1e20, 0);
    body.set_rigid(1, 0, 0);
    Attempt const large(body.problem(), &options);
    CHECK(large.status == HM_UNSUPPORTED);
    CHECK(std::string(large.error.text).find("a right-hand side at point") == 0);
    CHECK(large.error.value != 0);
    options.precision = HM_DOUBLE;
    CHECK(Attempt(body.problem(), &options).status == HM_OK);
}
