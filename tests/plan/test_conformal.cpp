// The functions of the conformal operator: values on the boundary and complex linearity.
#include <harmorph_design.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/operators.hpp>

using namespace fixtures;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

}  // namespace

TEST_CASE("without a weight the functions are those of Laplace's equation, and real") {
    for (Cells const kind : kinds) {
        Case setup = two_body_case(kind, 8, 6);
        Options const conformal = options_of(HM_CONFORMAL, -1), paper = options_of(HM_LAPLACE);
        Solved const a(setup, &conformal), b(setup, &paper);
        CHECK(a.info().exponent == 0);
        for (std::int32_t i = 0; i < 20; ++i)
            CHECK(largest_difference(complex_values(a, i), complex_values(b, i)) < 1e-13);
        Options const weighted = options_of(HM_CONFORMAL);  // and with one they are not
        Solved const c(setup, &weighted);
        CHECK(c.info().exponent == 1.5);
        double imaginary = 0;
        for (Complex const f : complex_values(c, 3))
            imaginary = std::fmax(imaginary, std::fabs(f.imag()));
        CHECK(imaginary > 1e-2);
    }
}

TEST_CASE("for all operators the functions are N_i(u) on the curves, and 0 on fixed points") {
    for (Cells const kind : kinds) {
        for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE, HM_WEIGHTED}) {
            Case setup = two_body_case(kind, 8, 6);
            Solved const solved(setup, options_of(operator_kind));
            CHECK(solved.report.boundary_error == 0);
            CHECK(solved.report.partition_defect < 1e-15);
            hm_basis_info const info = solved.info();
            std::vector<Field> functions;
            for (std::int32_t i = 0; i < 20; ++i) functions.push_back(complex_values(solved, i));
            for (std::int32_t k = 0; k < info.curve_points; ++k) {
                std::size_t const point = std::size_t(info.curve_point[k]);
                std::int32_t control[6];
                double value[6];
                REQUIRE(hm_curve_basis(&setup.curves.view(), info.point_curve[k], info.point_u[k],
                                       0, control, value, nullptr) == HM_OK);
                Field expected(20, 0);
                int const degree = setup.curves.shapes[std::size_t(info.point_curve[k])].degree;
                for (int j = 0; j <= degree; ++j) expected[std::size_t(control[j])] += value[j];
                for (std::size_t i = 0; i < 20; ++i) CHECK(functions[i][point] == expected[i]);
            }
            for (std::int32_t const point : points_on(setup.mesh, far_field))
                for (Field const& f : functions) CHECK(f[std::size_t(point)] == 0.0);
        }
    }
}

TEST_CASE("turning all movements turns all displacements of a conformal morph") {
    Case setup = airfoil_case();
    Options const options = options_of(HM_CONFORMAL);
    Solved const solved(setup, &options);
    std::vector<double> const move = some_move(12, 1, 13), other = some_move(12, 1, 14);
    Field const moved = displacement(solved, move), also = displacement(solved, other);
    for (Complex const by : {Complex(0, 1), Complex(-1, 0), Complex(0.6, 1.7)}) {
        Field expected;
        for (Complex const d : moved) expected.push_back(by * d);
        CHECK(largest_difference(displacement(solved, turned(move, by)), expected) < 1e-14);
    }
    std::vector<double> sum;
    for (std::size_t k = 0; k < move.size(); ++k) sum.push_back(move[k] + 3 * other[k]);
    Field expected;
    for (std::size_t k = 0; k < moved.size(); ++k) expected.push_back(moved[k] + 3.0 * also[k]);
    CHECK(largest_difference(displacement(solved, sum), expected) < 1e-13);
}

TEST_CASE("a free boundary is refused with a hint at slip, and so are unknown exponents") {
    Case setup = ring_case(6, 24, 0.5, 2);
    setup.set_free(far_field);
    for (double const exponent : {0.0, 1.5, -1.0}) {
        Options const options = options_of(HM_CONFORMAL, exponent);
        Attempt const attempt(setup.problem(), &options);
        CHECK(attempt.status == HM_UNSUPPORTED);
        CHECK(attempt.reached == "analysis size");
        CHECK(says(attempt.error, "slip"));
    }
    Attempt const by_default(setup.problem(), nullptr);
    CHECK(by_default.status == HM_OK);  // the fixture's default is Laplace's operator
    setup.conditions.pop_back();
    for (double const exponent : {0.1, 3.9999, 4.25, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
        Options const options = options_of(HM_CONFORMAL, exponent);
        CHECK(Attempt(setup.problem(), &options).status == HM_BAD_ARGUMENT);
    }
}
