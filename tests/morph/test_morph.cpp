// A morph is linear, exact on the curve, and transposed by its adjoint.
#include <harmorph_design.h>
#include <harmorph_study.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/single.hpp>
#include <fixtures/traps.hpp>
#include <fixtures/wrong.hpp>

using namespace fixtures;

TEST_CASE("the displacement is the sum of functions times movements") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    std::int32_t const n = setup.curves.n_control();
    Numbers const move = some_move(n, 0.01, 1);
    Moved const found = displaced(solved.basis, move);
    Numbers mx, my;
    for (std::size_t i = 0; i < std::size_t(n); ++i) {
        mx.push_back(move[2 * i]);
        my.push_back(move[2 * i + 1]);
    }
    CHECK(largest_difference(found.x, solved.combined(mx)) < 1e-16);
    CHECK(largest_difference(found.y, solved.combined(my)) < 1e-16);
}

TEST_CASE("a morph is linear in the movement, also for more functions than one block of them") {
    // 150 functions: the product is blocked by 128. 3 functions: less than a vector.
    for (int const n : {150, 3}) {
        Case setup = ring_case(5, 300, 0.5, 2, Cells::hybrid, 2, n);
        Solved const solved(setup);
        Numbers const a = some_move(n, 1, 2), b = some_move(n, 1, 3);
        Numbers both;
        for (std::size_t k = 0; k < a.size(); ++k) both.push_back(a[k] - 2.5 * b[k]);
        Moved const of_a = displaced(solved.basis, a), of_b = displaced(solved.basis, b),
                    of_both = displaced(solved.basis, both);
        Numbers expected;
        for (std::size_t k = 0; k < of_a.y.size(); ++k)
            expected.push_back(of_a.y[k] - 2.5 * of_b.y[k]);
        CHECK(largest_difference(of_both.y, expected) < 1e-14);

        Numbers twice;
        for (double const m : a) twice.push_back(2 * m);
        Moved const of_twice = displaced(solved.basis, twice);
        for (double& x : expected) x = 0;
        for (std::size_t k = 0; k < expected.size(); ++k) expected[k] = 2 * of_a.x[k];
        CHECK(same_bits(of_twice.x, expected));
    }
}

TEST_CASE("the adjoint is the transpose: <g, F m> = <F^T g, m>") {
    for (int const n : {4, 9, 150}) {
        Case setup = ring_case(20, 300, 0.5, 2, Cells::hybrid, 3,
                               n);  // 6300 points: more than one block of them
        Solved const solved(setup);
        check_adjoint(solved.basis, some_move(n, 1, 4), 1e-14);
    }
}

TEST_CASE("in place and to another array, in any layout: the same bits") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    std::size_t const n = setup.mesh.x.size();
    Numbers const move = some_move(setup.curves.n_control(), 0.01, 7);
    Moved const expected = morphed(solved.basis, setup.mesh, move);
    struct Layout {
        std::size_t x, y, stride, size;  // where x and y begin
    };
    Layout const layouts[] = {
        {0, n, 1, 2 * n}, {0, 1, 2, 2 * n}, {1, 4, 5, 5 * n}, {2, 0, 3, 3 * n}};
    for (Layout const& from : layouts) {
        Numbers old(from.size, -77.0);
        for (std::size_t k = 0; k < n; ++k) {
            old[from.x + k * from.stride] = setup.mesh.x[k];
            old[from.y + k * from.stride] = setup.mesh.y[k];
        }
        auto const compare = [&](Numbers const& all, Layout const& layout) {
            Wrong wrong;
            std::size_t others = 0;
            for (std::size_t k = 0; k < n; ++k) {
                wrong.compare(k, all[layout.x + k * layout.stride], expected.x[k]);
                wrong.compare(k, all[layout.y + k * layout.stride], expected.y[k]);
            }
            for (double const value : all) others += value == -77.0;
            CHECK(wrong == 0);
            CHECK(others == layout.size - 2 * n);  // nothing else is written
        };
        for (Layout const& to : layouts) {
            Numbers made(to.size, -77.0);
            REQUIRE(hm_morph(solved.basis, move.data(),
                             points_in(&old[from.x], &old[from.y], std::int64_t(from.stride)),
                             points_out(&made[to.x], &made[to.y], std::int64_t(to.stride)), nullptr,
                             nullptr) == HM_OK);
            compare(made, to);
        }
        REQUIRE(hm_morph(solved.basis, move.data(),
                         points_in(&old[from.x], &old[from.y], std::int64_t(from.stride)),
                         points_out(&old[from.x], &old[from.y], std::int64_t(from.stride)), nullptr,
                         nullptr) == HM_OK);
        compare(old, from);
    }
}

TEST_CASE("displacements added to the mesh are the morphed mesh") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    Numbers const move = some_move(setup.curves.n_control(), 0.01, 8);
    Moved const by = displaced(solved.basis, move), to = morphed(solved.basis, setup.mesh, move);
    Numbers expected;
    for (std::size_t k = 0; k < by.x.size(); ++k)
        expected.push_back(by.x[k] == 0 ? setup.mesh.x[k] : setup.mesh.x[k] + by.x[k]);
    CHECK(same_bits(to.x, expected));
}

TEST_CASE("points on the curve move as the B-spline does, to 1e-12") {
    for (bool const weighted : {false, true}) {
        Case setup = two_body_case();
        if (weighted)
            for (int k = 0; k < 20; ++k) setup.curves.weights.push_back(1 + 0.1 * k);
        Solved const solved(setup);
        Numbers const move = some_move(20, 0.3, 9);
        Moved const by = displaced(solved.basis, move);
        CurveSet moved = setup.curves;
        for (std::size_t k = 0; k < move.size(); ++k) moved.control[k] += move[k];
        hm_basis_info const info = solved.info();
        CHECK(info.curve_points == 96);
        double largest = 0;
        for (std::int32_t k = 0; k < info.curve_points; ++k) {
            double before[2], after[2];
            REQUIRE(hm_curve_point(&setup.curves.view(), info.point_curve[k], info.point_u[k], 0,
                                   before, nullptr) == HM_OK);
            REQUIRE(hm_curve_point(&moved.view(), info.point_curve[k], info.point_u[k], 0, after,
                                   nullptr) == HM_OK);
            std::size_t const point = std::size_t(info.curve_point[k]);
            largest = std::fmax(largest, std::fabs(by.x[point] - (after[0] - before[0])));
            largest = std::fmax(largest, std::fabs(by.y[point] - (after[1] - before[1])));
        }
        CHECK(largest < 1e-12);

        Moved const to = morphed(solved.basis, setup.mesh, move);
        std::int32_t worst = -5;
        auto const error_at = [&](Moved const& at) {
            return boundary_error(solved.basis, move, setup.mesh, at, &worst);
        };
        CHECK(error_at(to) < 1e-12);
        // A point that is elsewhere is found.
        Moved wrong = to;
        std::size_t const shifted = std::size_t(info.curve_point[17]);
        wrong.y[shifted] += 1e-3;
        CHECK(error_at(wrong) == doctest::Approx(1e-3).epsilon(1e-9));
        CHECK(worst == info.curve_point[17]);
        Untrapped const untrapped;
        wrong.x[std::size_t(info.curve_point[3])] = std::nan("");
        CHECK(std::isnan(error_at(wrong)));
        CHECK(worst == info.curve_point[3]);
    }
}

TEST_CASE("a movement that is not finite is refused, and nothing is written") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    Numbers move(2 * std::size_t(setup.curves.n_control()), 0.1);
    for (double const bad : {std::nan(""), HUGE_VAL}) {
        move[9] = bad;
        Mesh mesh = setup.mesh;
        hm_error error{};
        CHECK(hm_morph(solved.basis, move.data(), points_in(mesh.x, mesh.y),
                       points_out(mesh.x, mesh.y), nullptr, &error) == HM_BAD_ARGUMENT);
        CHECK(error.item == 4);
        CHECK(same_bits(mesh.x, setup.mesh.x));
    }
}

TEST_CASE("a point that does not move keeps its bits, also those of -0") {
    Case setup = cut_ring(
        30, 11);  // the last block of points is filled in part; a cut joins points to the wall
    Solved const solved(setup);
    Single const single(solved.basis);
    std::size_t const n = setup.mesh.x.size();
    Numbers move(std::size_t(2 * solved.info().functions), 0.0);
    for (bool const moves_x : {false, true}) {
        for (std::size_t k = 0; k < move.size(); k += 2)
            move[k] = moves_x ? 0.25 : 0;  // never along y
        for (const hm_basis* const basis : {static_cast<const hm_basis*>(solved.basis),
                                            static_cast<const hm_basis*>(single.basis)}) {
            for (std::int64_t const stride : {1, 2, 3}) {
                std::size_t const step = std::size_t(stride);
                Numbers const before(n * step, -0.0);
                Numbers x(n * step, 7.0), y = x;
                hm_points const from{before.data(), before.data(), stride};
                hm_points_out const to{x.data(), y.data(), stride};
                REQUIRE(hm_morph(basis, move.data(), &from, &to, nullptr, nullptr) == HM_OK);
                Wrong bits_of_x, bits_of_y;
                for (std::size_t k = 0; k < n * step; k += step) {
                    bits_of_x.add(x[k] == 0 && !std::signbit(x[k]), std::int32_t(k), x[k]);
                    bits_of_y.add(y[k] != 0 || !std::signbit(y[k]), std::int32_t(k), y[k]);
                }
                CHECK(bits_of_x == 0);
                CHECK(bits_of_y == 0);
            }
        }
    }
}
