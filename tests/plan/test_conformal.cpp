// The functions of the conformal operator: values on the boundary, complex linearity, and what
// follows from symmetries.
#include <harmorph_design.h>
#include "fixtures/options.hpp"
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
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

TEST_CASE("the functions are N_i(u) on the curves, without imaginary part, and 0 on fixed points") {
    for (Cells const kind : kinds) {
        Case setup = two_body_case(kind, 8, 6);
        Options const options = options_of(HM_CONFORMAL);
        Solved const solved(setup, &options);
        CHECK(solved.report.boundary_error == 0);
        CHECK(solved.report.partition_defect < 1e-15);
        hm_basis_info const info = solved.info();
        std::vector<Field> functions;
        for (std::int32_t i = 0; i < 20; ++i) functions.push_back(complex_values(solved, i));
        for (std::int32_t k = 0; k < info.curve_points; ++k) {
            std::size_t const point = static_cast<std::size_t>(info.curve_point[k]);
            std::int32_t control[6];
            double value[6];
            REQUIRE(hm_curve_basis(&setup.curves.view(), info.point_curve[k], info.point_u[k], 0,
                                   control, value, nullptr) == HM_OK);
            Field expected(20, 0);
            int const degree =
                setup.curves.shapes[static_cast<std::size_t>(info.point_curve[k])].degree;
            for (int j = 0; j <= degree; ++j)
                expected[static_cast<std::size_t>(control[j])] += value[j];
            for (std::size_t i = 0; i < 20; ++i) CHECK(functions[i][point] == expected[i]);
        }
        for (std::int32_t const point : points_on(setup.mesh, far_field))
            for (Field const& f : functions) CHECK(f[static_cast<std::size_t>(point)] == 0.0);
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

TEST_CASE("control points that are moved by a similarity move the wall by the same similarity") {
    Case setup = ring_case(8, 32, 0.5, 2, Cells::hybrid);
    Options const options = options_of(HM_CONFORMAL);
    Solved const solved(setup, &options);
    // Points on the fitted curve: the mesh's own are beside it and keep their offset, unturned.
    for (Complex const centre : {Complex(0, 0), Complex(0.7, -3)})
        for (Complex const s : {std::polar(1.0, 1.0), Complex(-2, 0.5)}) {
            Field const found =
                displacement(solved, similarity_move(setup.curves, s, centre, {0.1, 0.2}));
            hm_basis_info const info = solved.info();
            for (std::int32_t k = 0; k < info.curve_points; ++k) {
                double xy[2];
                REQUIRE(hm_curve_point(&setup.curves.view(), 0, info.point_u[k], 0, xy, nullptr) ==
                        HM_OK);
                Complex const expected =
                    (s - 1.0) * (Complex(xy[0], xy[1]) - centre) + Complex(0.1, 0.2);
                CHECK(std::abs(found[static_cast<std::size_t>(info.curve_point[k])] - expected) <
                      1e-14);
            }
        }
}

TEST_CASE("numbering, orientation, markers, place and size of the mesh do not matter") {
    Case const origin = airfoil_case(30, 10);
    Options const options = options_of(HM_CONFORMAL);
    Case setup = origin;
    Solved const reference(setup, &options);
    auto const compare = [&](Case& changed, std::vector<std::int32_t> const& new_of,
                             bool mirrored) {
        Solved const solved(changed, &options);
        double worst = 0;
        for (std::int32_t i = 0; i < 10; ++i) {
            Field const expected = complex_values(reference, i), found = complex_values(solved, i);
            for (std::size_t k = 0; k < expected.size(); ++k) {
                Complex const f = found[new_of.empty() ? k : static_cast<std::size_t>(new_of[k])];
                worst = std::fmax(worst, std::abs((mirrored ? std::conj(f) : f) - expected[k]));
            }
        }
        CHECK(worst < 1e-10);
    };
    Case changed = origin;
    std::vector<std::int32_t> const new_of = renumber_points(changed.mesh, 3);
    shuffle_cells(changed.mesh, 4);
    compare(changed, new_of, false);
    changed = origin;
    reverse_all(changed.mesh);
    compare(changed, {}, false);
    reverse_some(changed.mesh, 5);
    rotate_starts(changed.mesh, 6);
    reverse_some_faces(changed.mesh, 7);
    split_marker(changed.mesh, body, 3, 31);
    changed.conditions.clear();
    for (std::int32_t const marker : {31, 32, 33}) changed.put_on_curves(marker);
    compare(changed, {}, false);
    changed = similar(origin, std::polar(3.0, 0.7), {2, -5});
    compare(changed, {}, false);
    changed = origin;  // the mirror image has the conjugate functions
    for (double& y : changed.mesh.y) y = -y;
    for (std::size_t k = 1; k < changed.curves.control.size(); k += 2)
        changed.curves.control[k] *= -1;
    compare(changed, {}, true);
    reverse_all(changed.mesh);
    compare(changed, {}, true);
}

TEST_CASE("the functions do not depend on the unit of length, from 1e-30 to 1e30") {
    Case const origin = airfoil_case(20, 8);
    Options const options = options_of(HM_CONFORMAL);
    Case setup = origin;
    Solved const reference(setup, &options);
    for (double const unit : {1e-3, 1024.0, 1e30, 1e-30}) {
        Case scaled = similar(origin, unit, 0);
        Solved const solved(scaled, &options);
        for (std::int32_t i = 0; i < 8; ++i)
            CHECK(largest_difference(complex_values(solved, i), complex_values(reference, i)) <
                  1e-9);
    }
}

TEST_CASE("a free boundary is refused with a hint at slip, and so are unknown exponents") {
    Case setup = ring_case(6, 24, 0.5, 2);
    setup.set_free(far_field);
    for (double const exponent : {0.0, 1.5, -1.0}) {
        Options const options = options_of(HM_CONFORMAL, exponent);
        Attempt const attempt(setup.problem(), &options);
        CHECK(attempt.status == HM_UNSUPPORTED);
        CHECK(attempt.reached == "analysis size");
        CHECK(std::string(attempt.error.text).find("slip") != std::string::npos);
    }
    Attempt const by_default(setup.problem(), nullptr);
    CHECK(by_default.status == HM_OK);  // the fixture's default is Laplace's operator
    setup.conditions.pop_back();
    for (double const exponent : {0.1, 3.9999, 4.25, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
        Options const options = options_of(HM_CONFORMAL, exponent);
        CHECK(Attempt(setup.problem(), &options).status == HM_BAD_ARGUMENT);
    }
    Options options = options_of(HM_LAPLACE, 1);
    CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
    options = options_of(1000);
    CHECK(Attempt(setup.problem(), &options).status == HM_UNSUPPORTED);
}

TEST_CASE("any number of threads gives the same bits, and kernels agree to rounding") {
    Case setup = airfoil_case();
    Options const plain = options_of(HM_CONFORMAL);
    Solved const reference(setup, &plain);
    std::vector<double> const move = some_move(12, 1, 15);
    Field const expected = displacement(reference, move);
    for (std::int32_t const threads : {2, 3}) {
        Backwards backwards;
        hm_executor const executor = backwards.executor(threads);
        Options options = plain;
        options.executor = &executor;
        Solved const solved(setup, &options);
        CHECK(backwards.tasks > 0);
        CHECK(displacement(solved, move) == expected);
    }
    for (std::int32_t const kernel :
         {HM_KERNEL_BASELINE, HM_KERNEL_AVX2, HM_KERNEL_AVX512, HM_KERNEL_NEON}) {
        auto executor = sized<hm_executor>();
        executor.kernel = kernel;
        Options options = plain;
        options.executor = &executor;
        Attempt const attempt(setup.problem(), &options);
        if (attempt.status == HM_UNSUPPORTED) continue;
        REQUIRE(attempt.status == HM_OK);
        CHECK(largest_difference(displacement(attempt.basis, move), expected) < 1e-10);
    }
}
