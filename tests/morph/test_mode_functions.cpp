// Functions by table: solved as hm_displace solves, used as any function.
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/single.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/channels.hpp>

#include <cstring>
#include <string>

using namespace fixtures;

namespace {

void check_near(Moved const& found, Moved const& expected, double tolerance) {
    CHECK(largest_difference(found.x, expected.x) < tolerance);
    CHECK(largest_difference(found.y, expected.y) < tolerance);
}

}  // namespace

TEST_CASE("B-spline functions given as tables are the functions of the curve") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL}) {
        Case curve = ring_case(6, 30, 0.5, 1);
        Options const options = options_of(kind);
        Solved const solved(curve, &options);
        Case table = given_instead(curve);
        Displaced displaced(table, &options);
        std::vector<Field> modes(8);
        for (std::int32_t const point : displaced.points)
            for (std::int32_t i = 0; i < 8; ++i)
                modes[std::size_t(i)].push_back(solved.values(i)[std::size_t(point)]);
        Tabulated const tabulated(displaced.plan, displaced.basis, modes, 1);
        REQUIRE_MESSAGE(tabulated.status == HM_OK, tabulated.error.text);
        hm_basis_info const info = info_of(tabulated.basis);
        CHECK(info.functions == 8);
        CHECK(info.modes == 8);
        CHECK(info.numbers_per_value == solved.info().numbers_per_value);
        Numbers const move = some_move(8, 0.1, 3);
        Moved const expected = morphed(solved.basis, curve.mesh, move),
                    found = morphed(tabulated.basis, curve.mesh, move);
        check_near(found, expected, 1e-12);
    }
}

TEST_CASE("modes move as given displacements beside curves and bodies, with an exact transpose") {
    Case slipping = given_instead(half_ring(8, 16, Cells::hybrid, 0.2, 4));
    Case curve = curve_and_table(), rigid = curve_and_table();
    rigid.conditions.clear();
    rigid.set_rigid(body, 0.5, 0.5);
    rigid.set_given(second_body);
    for (Case* setup : {&curve, &rigid, &slipping})
        for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL})
            for (std::int32_t const numbers : {1, 2}) {
                Options const options = options_of(kind);
                Attempt solved(setup->problem(), &options);
                INFO(solved.error.text);
                REQUIRE(solved.status == HM_OK);
                std::vector<std::int32_t> const points = given_points(solved.plan);
                std::vector<Field> modes = {some_field(points.size(), 5, 0.02),
                                            some_field(points.size(), 6, 0.02)};
                for (Field& mode : modes)
                    for (auto& value : mode)
                        if (numbers == 1) value = value.real();
                Tabulated const tabulated(solved.plan, solved.basis, modes, numbers);
                REQUIRE_MESSAGE(tabulated.status == HM_OK, tabulated.error.text);
                hm_basis_info const before = info_of(solved.basis), info = info_of(tabulated.basis);
                INFO("operator " << kind << ", matrix of " << numbers << ", values of "
                                 << info.numbers_per_value);
                CHECK(info.functions == before.functions + 2);

                // Amplitudes alone: the displacement of the sum of the modes times amplitudes.
                Numbers move(2 * std::size_t(info.functions));
                std::complex<double> const a(0.7, -0.3), b(-0.2, 0.9);
                move[move.size() - 4] = a.real(), move[move.size() - 3] = a.imag();
                move[move.size() - 2] = b.real(), move[move.size() - 1] = b.imag();
                Field wall;
                for (std::size_t k = 0; k < points.size(); ++k)
                    wall.push_back(a * modes[0][k] + b * modes[1][k]);
                Moved const found = displaced(tabulated.basis, move);
                Guarded work = block_of(fixtures::displace_size, solved.plan, 1);
                Moved expected = found;
                Numbers wall_x, wall_y;
                for (auto const& value : wall)
                    wall_x.push_back(value.real()), wall_y.push_back(value.imag());
                hm_points const from{wall_x.data(), wall_y.data(), 1};
                hm_points_out const to{expected.x.data(), expected.y.data(), 1};
                REQUIRE(hm_displace(solved.plan, std::int32_t(points.size()), nullptr, 1, &from,
                                    nullptr, &to, fixtures::Memory(work.data(), work.size()),
                                    nullptr, nullptr) == HM_OK);
                check_near(found, expected, 1e-14);
                for (std::size_t k = 0; k < points.size(); ++k) {
                    auto const at = std::size_t(points[k]);
                    CHECK(std::fabs(found.x[at] - wall_x[k]) < 1e-16);
                }

                // The other functions.
                if (before.functions > 0) {
                    Numbers others = some_move(before.functions, 0.01, 4);
                    Moved const old = displaced(solved.basis, others);
                    others.resize(move.size());
                    Moved const same = displaced(tabulated.basis, others);
                    CHECK(same.x == old.x);
                    CHECK(same.y == old.y);
                }

                Gradient const g(found.x.size(), 8);
                Numbers const all = some_move(info.functions, 0.01, 9),
                              slope = adjoint(tabulated.basis, g);
                Moved const moved = displaced(tabulated.basis, all);
                double work_on_wall = 0, work_on_mesh = 0, parts = 0;
                for (std::size_t k = 0; k < all.size(); ++k) work_on_wall += all[k] * slope[k];
                for (std::size_t k = 0; k < moved.x.size(); ++k) {
                    work_on_mesh += g.x[k] * moved.x[k] + g.y[k] * moved.y[k];
                    parts += std::fabs(g.x[k] * moved.x[k]) + std::fabs(g.y[k] * moved.y[k]);
                }
                CHECK(std::fabs(work_on_wall - work_on_mesh) <= 1e-14 * parts);

                // The functions are compared as a block, and as the rows of some points.
                std::vector<unsigned char> const copy = bytes_of(tabulated.basis);
                Numbers block(copy.size() / sizeof(double));
                std::memcpy(block.data(), copy.data(), copy.size());
                hm_mesh const mesh = setup->mesh_view();
                const hm_basis* attached = nullptr;
                REQUIRE(hm_basis_attach(&attached, block.data(), copy.size(), &mesh, nullptr) ==
                        HM_OK);
                CHECK(displaced(attached, move).x == found.x);
                Rows const rows(tabulated.basis, points);
                REQUIRE(rows.status == HM_OK);
                CHECK(displaced(rows.basis, move).x[0] == found.x[std::size_t(points[0])]);

                // Solved again on a moved mesh: as displaced there, and the wall as before.
                Numbers part = move;
                for (double& number : part) number *= 0.1;
                Moved const elsewhere = morphed(tabulated.basis, setup->mesh, part);
                REQUIRE(hm_plan_factor(solved.plan, points_in(elsewhere.x, elsewhere.y), nullptr) ==
                        HM_OK);
                auto report = sized<hm_solve_report>();
                REQUIRE(hm_plan_solve(solved.plan, tabulated.basis, &report, nullptr) == HM_OK);
                CHECK(report.functions == info.functions);
                CHECK(report.residual < 1e-12);
                CHECK(report.boundary_error_point == -1);
                Moved const again = displaced(tabulated.basis, move);
                REQUIRE(hm_displace(solved.plan, std::int32_t(points.size()), nullptr, 1, &from,
                                    nullptr, &to, fixtures::Memory(work.data(), work.size()),
                                    nullptr, nullptr) == HM_OK);
                check_near(again, expected, 1e-14);
                for (std::int32_t const point : points) {
                    auto const at = std::size_t(point);
                    CHECK(again.x[at] == found.x[at]);
                    CHECK(again.y[at] == found.y[at]);
                }
            }
}

TEST_CASE("a cancelled solution leaves the table, and the next one uses it") {
    Case setup = curve_and_table();
    Solved const solved(setup);
    std::size_t const n = given_points(solved.plan).size();
    Tabulated const tabulated(solved.plan, solved.basis,
                              {some_field(n, 5, 0.02), some_field(n, 6, 0.02)}, 2);
    REQUIRE(tabulated.status == HM_OK);
    Numbers const move = some_move(info_of(tabulated.basis).functions, 0.1, 7);
    Moved const before = displaced(tabulated.basis, move);
    struct Stop {
        std::int32_t phase;
        static std::int32_t at(void* user, std::int32_t phase, double) {
            return phase == static_cast<Stop*>(user)->phase;
        }
    } stop{HM_PHASE_SOLVE};
    Options options = laplace();
    options.progress = Stop::at;
    options.progress_user = &stop;
    Attempt second;
    REQUIRE(second.analyse(setup.problem(), &options));
    REQUIRE(second.prepare());
    REQUIRE(hm_plan_factor(second.plan, nullptr, nullptr) == HM_OK);
    for (std::int32_t const phase : {HM_PHASE_SOLVE, HM_PHASE_RESIDUAL}) {
        stop.phase = phase;
        REQUIRE(hm_plan_solve(second.plan, tabulated.basis, nullptr, nullptr) == HM_CANCELLED);
        CHECK(info_of(tabulated.basis).solved == 0);
    }
    stop.phase = -1;
    REQUIRE(hm_plan_solve(second.plan, tabulated.basis, nullptr, nullptr) == HM_OK);
    check_near(displaced(tabulated.basis, move), before, 1e-14);
}

TEST_CASE("modes on top of combined functions and of other modes; too many are not solved again") {
    Case setup = curve_and_table();
    Solved const solved(setup);
    std::size_t const n = given_points(solved.plan).size();
    std::int32_t const controls = info_of(solved.basis).control_points;
    Combination const matrix(controls, 2, 1, 2);
    Combined const combined(solved.basis, matrix);
    Tabulated const one(solved.plan, combined.basis, {some_field(n, 5, 0.02)}, 2);
    REQUIRE_MESSAGE(one.status == HM_OK, one.error.text);
    Tabulated const two(solved.plan, one.basis, {some_field(n, 6, 0.02)}, 2);
    REQUIRE_MESSAGE(two.status == HM_OK, two.error.text);
    CHECK(info_of(two.basis).combined == 2);
    CHECK(info_of(two.basis).modes == 2);
    Numbers const few = {0.1, -0.2, 0.05, 0.1, 0, 0, 0, 0};
    Moved const found = displaced(two.basis, few),
                expected = displaced(combined.basis, {few.begin(), few.begin() + 4});
    CHECK(found.x == expected.x);
    CHECK(found.y == expected.y);
    std::vector<double> control(2 * std::size_t(controls));  // the matrix is still there
    std::vector<hm_curve> curve(2);
    for (hm_curve& one_curve : curve) one_curve.struct_size = sizeof one_curve;
    auto curves = sized<hm_curves>();
    REQUIRE(hm_basis_curves(two.basis, few.data(), control.data(), &curves, curve.data(), 2,
                            nullptr) == HM_OK);
    Numbers const by = matrix.expanded({few.begin(), few.begin() + 4});
    for (std::size_t i = 0; i < control.size(); ++i)
        CHECK(control[i] - setup.curves.control[i] == doctest::Approx(by[i]).epsilon(1e-12));

    std::vector<Field> many;
    for (unsigned k = 0; k < 600; ++k) many.push_back(some_field(n, k, 0.02));
    Tabulated const large(solved.plan, solved.basis, many, 2);
    REQUIRE(large.status == HM_OK);
    hm_error error{};
    CHECK(hm_plan_solve(solved.plan, large.basis, nullptr, &error) == HM_UNSUPPORTED);
    CHECK_MESSAGE(std::string(error.text)
                          .find("the basis has 1240 numbers at a point, but this plan solves bases "
                                "with at most 1044") != std::string::npos,
                  error.text);
    CHECK(info_of(large.basis).solved == 1);
}

TEST_CASE("modes stay behind combined functions") {
    Case setup = curve_and_table();
    Solved const solved(setup);
    std::vector<std::int32_t> const points = given_points(solved.plan);
    Tabulated const tabulated(solved.plan, solved.basis, {some_field(points.size(), 5, 0.02)}, 2);
    REQUIRE(tabulated.status == HM_OK);
    std::int32_t const n = info_of(tabulated.basis).control_points;
    Numbers matrix = some_move(n, 1, 2);
    Guarded block = block_of(fixtures::combine_size, tabulated.basis, 2, 1);
    hm_basis* combined = nullptr;
    REQUIRE(hm_combine(&combined, fixtures::Memory(block.data(), block.size()), tabulated.basis, 2,
                       1, matrix.data(), nullptr) == HM_OK);
    CHECK(info_of(combined).functions == 3);
    CHECK(info_of(combined).modes == 1);
    Numbers few(6), all(2 * std::size_t(n) + 2);
    few[4] = all[all.size() - 2] = 0.4;
    few[5] = all[all.size() - 1] = -0.6;
    CHECK(displaced(combined, few).y == displaced(tabulated.basis, all).y);
}

TEST_CASE("tables that cannot be used are refused by name, with nothing written") {
    Case setup = curve_and_table();
    Solved const solved(setup);
    std::vector<std::int32_t> points = given_points(solved.plan);
    Field const good = some_field(points.size(), 5), zero(points.size());
    auto const refusal = [&](Tabulated const& made, std::string const& word, int item) {
        CHECK(made.basis == nullptr);
        CHECK_MESSAGE(says(made.error, word), made.error.text);
        CHECK(made.error.item == item);
        return made.status;
    };
    CHECK(refusal({solved.plan, solved.basis, {good, zero}, 2}, "mode 1 is zero: it moves no point",
                  1) == HM_BAD_CONDITION);
    Field bad = good;
    bad[3] = std::nan("");
    CHECK(refusal({solved.plan, solved.basis, {bad}, 1}, "point 3", 0) == HM_BAD_ARGUMENT);
    CHECK(Tabulated(solved.plan, solved.basis, {good}, 3).status == HM_BAD_ARGUMENT);
    CHECK(Tabulated(solved.plan, solved.basis, {Field(good.begin(), good.end() - 1)}, 1).status ==
          HM_BAD_ARGUMENT);
    std::int32_t const last = points.back();
    points.back() = points.front();
    CHECK(refusal({solved.plan, solved.basis, {good}, 1, &points}, "but not in the list", last) ==
          HM_BAD_CONDITION);
    CHECK(Tabulated(solved.plan, solved.basis, {good}, 1, nullptr, 1).status == HM_BLOCK_TOO_SMALL);
    Case other = two_body_case(Cells::hybrid, 8, 6);
    Solved const on_curves(other);
    CHECK(refusal({on_curves.plan, on_curves.basis, {good}, 1}, "HM_GIVEN", -1) ==
          HM_BAD_CONDITION);
    CHECK(Tabulated(solved.plan, on_curves.basis, {good}, 1).status == HM_BAD_BASIS);
}
