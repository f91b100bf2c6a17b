// Functions in single precision: the wall moves as with double ones, the rest to the stated bound,
// and the adjoint is the transpose of that.
#include "base/executor.hpp"

#include <fixtures/executors.hpp>
#include <fixtures/single.hpp>
#include <fixtures/wrong.hpp>

using namespace fixtures;

TEST_CASE("each number is rounded to single precision, except on the wall, where doubles remain") {
    for (KindOfProblem& problem : problems_and_a_cut()) {
        Solved const solved(problem.setup, &problem.options);
        Single const single(solved.basis, 24);
        REQUIRE(single.status == HM_OK);
        hm_basis_info const info = info_of(single.basis), whole = solved.info();
        CHECK(info.storage == HM_SINGLE);
        CHECK(whole.storage == HM_DOUBLE);
        CHECK(info.solved == 1);
        CHECK(info.points == whole.points);
        CHECK(info.cells == whole.cells);
        CHECK(info.functions == whole.functions);
        CHECK(info.curve_points == whole.curve_points);
        CHECK(info.numbers_per_value == whole.numbers_per_value);
        CHECK(same_bits<double>({info.point_u, info.point_u + info.curve_points},
                                {whole.point_u, whole.point_u + whole.curve_points}));
        if (problem.setup.mesh.n_points() > 10 * whole.curve_points)
            CHECK(3 * info.bytes < 2 * whole.bytes);
        std::vector<bool> const wall = wall_of(problem.setup);
        Matrices const before(solved.basis), after(single.basis);
        Wrong wrong;
        std::size_t on_wall = 0, rounded = 0;
        for (std::int32_t p = 0; p < info.numbers_per_value; ++p)
            for (std::size_t i = 0; i < before.plane[p].size(); ++i)
                for (std::size_t k = 0; k < wall.size(); ++k) {
                    double const was = before.plane[p][i][k], now = after.plane[p][i][k];
                    wrong.compare(k, now, wall[k] ? was : double(float(was)));
                    wrong.add(!(std::fabs(now - was) <= 0x1p-24 * std::fabs(was) + 0x1p-150), k,
                              now - was);
                    on_wall += wall[k] && was != double(float(was));
                    rounded += now != was;
                }
        CHECK(wrong == 0);
        CHECK(on_wall > 10);  // the test could have failed
        CHECK(rounded > 100);
    }
}

TEST_CASE("a single-precision morph moves the wall exactly and other points within the bound") {
    for (KindOfProblem& problem : problems_and_a_cut()) {
        Mesh const& mesh = problem.setup.mesh;
        Solved const solved(problem.setup, &problem.options);
        Single const single(solved.basis);
        Numbers const move = some_move(solved.info().functions, 0.05, 3);
        Moved const expected = morphed(solved.basis, mesh, move),
                    found = morphed(single.basis, mesh, move);
        Moved const by = displaced(solved.basis, move), by_floats = displaced(single.basis, move);
        std::vector<bool> const wall = wall_of(problem.setup);
        Matrices const functions(solved.basis);
        Wrong wrong;
        std::size_t differ = 0;
        for (std::size_t k = 0; k < wall.size(); ++k) {
            Magnitude const size(functions, move, k);
            double const rounding = 1e-15;
            wrong.add(!(std::fabs(by_floats.x[k] - by.x[k]) <= (0x1p-24 + rounding) * size.x), k,
                      by_floats.x[k] - by.x[k]);
            wrong.add(!(std::fabs(by_floats.y[k] - by.y[k]) <= (0x1p-24 + rounding) * size.y), k,
                      by_floats.y[k] - by.y[k]);
            if (wall[k]) {
                wrong.compare(k, by_floats.x[k], by.x[k]);
                wrong.compare(k, by_floats.y[k], by.y[k]);
                wrong.compare(k, found.x[k], expected.x[k]);
                wrong.compare(k, found.y[k], expected.y[k]);
            }
            if (size.x + size.y == 0) {
                wrong.compare(k, found.x[k], mesh.x[k]);
                wrong.compare(k, found.y[k], mesh.y[k]);
            }
            differ += by_floats.x[k] != by.x[k];
        }
        CHECK(wrong == 0);
        CHECK(differ > wall.size() / 4);
        CHECK(boundary_error(single.basis, move, mesh, found) < 1e-14);

        // The morph also works in place and in pairs; and the movement 0 keeps every bit.
        Numbers xy, nothing(move.size(), 0.0);
        for (std::size_t k = 0; k < mesh.x.size(); ++k) xy.insert(xy.end(), {mesh.x[k], mesh.y[k]});
        xy[0] = -0.0;
        Numbers const start = xy;
        double *const x = xy.data(), *const y = x + 1;
        REQUIRE(hm_morph(single.basis, nothing.data(), points_in(x, y, 2), points_out(x, y, 2),
                         nullptr, nullptr) == HM_OK);
        CHECK(same_bits(xy, start));
        xy[0] = mesh.x[0];
        REQUIRE(hm_morph(single.basis, move.data(), points_in(x, y, 2), points_out(x, y, 2),
                         nullptr, nullptr) == HM_OK);
        Wrong unequal;
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {
            unequal.compare(k, xy[2 * k], found.x[k]);
            unequal.compare(k, xy[2 * k + 1], found.y[k]);
        }
        CHECK(unequal == 0);
    }
}

TEST_CASE("both sides of a cut move as one, on the wall and off the wall") {
    Case setup = cut_ring(30);
    Solved const solved(setup);
    CHECK(solved.info().curve_points == 30);  // 31 points of the mesh are on the curve
    Single const single(solved.basis);
    // The list has the wall's other side, and not the side with the parameter.
    std::vector<std::int32_t> copy_alone = {30, 61, 5, 30};
    Rows const rows(single.basis, copy_alone);
    CHECK(info_of(rows.basis).curve_points == 2);
    Numbers const move = some_move(8, 0.05, 2);
    Moved const whole = displaced(solved.basis, move), by = displaced(single.basis, move),
                some = displaced(rows.basis, move);
    for (std::size_t k = 0; k < by.x.size(); k += 31) {
        CHECK(by.x[k] == by.x[k + 30]);
        CHECK(by.y[k] == by.y[k + 30]);
    }
    for (std::size_t const k : {0u, 30u}) {
        CHECK(by.x[k] == whole.x[k]);
        CHECK(by.y[k] == whole.y[k]);
    }
    CHECK(by.x[0] != double(float(by.x[0])));
    for (std::size_t const k : {0u, 3u}) {
        CHECK(some.x[k] == whole.x[30]);
        CHECK(some.y[k] == whole.y[30]);
    }
}

TEST_CASE("the functions sum to 1 in single precision, and on the curve in double precision") {
    Case setup = ring_case(20, 60, 0.5, 2);
    setup.set_free(far_field);  // then it is 1 everywhere
    Solved const solved(setup);
    Single const single(solved.basis);
    Numbers move;
    for (std::int32_t i = 0; i < solved.info().functions; ++i) move.insert(move.end(), {1.0, 0.0});
    Moved const found = displaced(single.basis, move);
    std::vector<bool> const wall = wall_of(setup);
    double worst = 0;
    for (std::size_t k = 0; k < wall.size(); ++k) {
        CHECK(std::fabs(found.x[k] - 1) <= (wall[k] ? 1e-15 : 0x1p-24 + 1e-10));  // solved to 1e-10
        worst = std::max(worst, std::fabs(found.x[k] - 1));
    }
    CHECK(worst > 1e-10);
}

TEST_CASE("the adjoint is within the stated bound, and <g, F m> = <F^T g, m>") {
    for (KindOfProblem& problem : problems_and_a_cut()) {
        Solved const solved(problem.setup, &problem.options);
        Single const single(solved.basis);
        Gradient const g(problem.setup.mesh.x.size(), 3);
        Numbers const found = adjoint(single.basis, g);
        Matrices const exact(single.basis);
        for (std::size_t i = 0; i < found.size() / 2; ++i) exact.check_gradient(i, g, found);
        Numbers const move = some_move(solved.info().functions, 1, 4);
        Moved const by = displaced(single.basis, move);
        double here = 0, there = 0, size = 0;
        for (std::size_t k = 0; k < by.x.size(); ++k) {
            here += g.x[k] * by.x[k] + g.y[k] * by.y[k];
            size += std::fabs(g.x[k] * by.x[k]) + std::fabs(g.y[k] * by.y[k]);
        }
        for (std::size_t k = 0; k < move.size(); ++k) there += found[k] * move[k];
        CHECK(std::fabs(here - there) <= 1e-14 * size);
        CHECK(std::fabs(here) > 1e-6 * size);
    }
}

TEST_CASE("rows of more than one block of numbers are right, and threads change no bit") {
    for (int const n : {150, 9}) {
        Case setup =
            ring_case(60, 300, 0.5, 2, Cells::quads, 3, n);  // 18300 points: several ranges
        Solved const solved(setup);
        Single const single(solved.basis);
        Numbers const move = some_move(n, 0.01, 5);
        Gradient const g(setup.mesh.x.size(), 6);
        Moved const expected = morphed(single.basis, setup.mesh, move),
                    exact = morphed(solved.basis, setup.mesh, move);
        Numbers const gradient = adjoint(single.basis, g);
        CHECK(largest_difference(expected.x, exact.x) < 1e-8);
        for (std::int32_t const threads : {2, 5}) {
            Backwards order;
            hm_executor const executor = order.executor(threads);
            Moved const again = morphed(single.basis, setup.mesh, move, &executor);
            CHECK(same_bits(again.x, expected.x));
            CHECK(same_bits(again.y, expected.y));
            CHECK(same_bits(adjoint(single.basis, g, &executor), gradient));
            if (harmorph::sharing(2) == 2) CHECK(order.tasks > 2);  // where flags are atomic
        }
    }
}

TEST_CASE("rows of single-precision functions are rounded rows, and parts add up to one gradient") {
    for (KindOfProblem& problem : problems_and_a_cut()) {
        Solved const solved(problem.setup, &problem.options);
        Single const single(solved.basis);
        std::int32_t const n = problem.setup.mesh.n_points();
        std::vector<std::int32_t> points = random_parts(n, 3, 8)[1];
        points.insert(points.end(),
                      {solved.info().curve_point[3], points.front(), solved.info().curve_point[3]});
        Rows const of_single(single.basis, points), of_double(solved.basis, points);
        REQUIRE(of_single.status == HM_OK);
        CHECK(bytes_of(Single(of_double.basis).basis) == bytes_of(of_single.basis));

        Mesh here;  // the wall is exact wherever the list names it
        for (std::int32_t const k : points) here.add_point(problem.setup.mesh.point(k));
        Numbers const move = some_move(solved.info().functions, 0.05, 3);
        Moved const all = morphed(single.basis, problem.setup.mesh, move),
                    some = morphed(of_single.basis, here, move);
        CHECK(same_bits(some.x, pick(all.x, points)));
        CHECK(same_bits(some.y, pick(all.y, points)));

        Gradient const g(problem.setup.mesh.x.size(), 5);
        Numbers const expected = adjoint(single.basis, g);
        for (std::size_t const parts : {1u, 2u, 7u, 40u})
            CHECK(
                same_bits(adjoint_in_parts(single.basis, g, random_parts(n, parts, 17)), expected));
    }
}
