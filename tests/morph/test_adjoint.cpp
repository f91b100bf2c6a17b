// The adjoint is exact to rounding, and has the same bits however the points are shared out.
#include "base/executor.hpp"
#include "private.h"
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/gradients.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;

using Numbers = std::vector<double>;

TEST_CASE("the sums are right, to the bound that is stated, for values of all kinds") {
    for (KindOfProblem& problem : kinds_of_problems()) {
        Solved const solved(problem.setup, &problem.options);
        Gradient const g(problem.setup.mesh.x.size(), 3);
        Numbers const found = adjoint(solved.basis, g);
        Matrices const exact(solved.basis);
        for (std::size_t i = 0; i < found.size() / 2; ++i) exact.check_gradient(i, g, found);
    }
}

TEST_CASE("the same bits for any parts of the mesh") {
    for (KindOfProblem& problem : kinds_of_problems()) {
        Solved const solved(problem.setup, &problem.options);
        Gradient const g(problem.setup.mesh.x.size(), 5);
        Numbers const expected = adjoint(solved.basis, g);
        std::int32_t const n = problem.setup.mesh.n_points();
        for (std::size_t const parts : {1u, 2u, 3u, 7u, 40u})
            CHECK(
                same_bits(adjoint_in_parts(solved.basis, g, random_parts(n, parts, 17)), expected));
        auto with_an_empty_one = random_parts(n, 2, 1);
        with_an_empty_one.insert(with_an_empty_one.begin(), std::vector<std::int32_t>{});
        CHECK(same_bits(adjoint_in_parts(solved.basis, g, with_an_empty_one), expected));
    }
}

TEST_CASE("the same bits on threads, in any order of their tasks") {
    Case setup = ring_case(50, 200, 0.5, 2);
    Solved const solved(setup);
    Gradient g(setup.mesh.x.size(), 15);
    Numbers const expected = adjoint(solved.basis, g);
    for (std::int32_t const threads : {2, 5}) {
        Backwards order;
        hm_executor const executor = order.executor(threads);
        CHECK(same_bits(adjoint(solved.basis, g, &executor), expected));
        if (harmorph::sharing(2) == 2)
            CHECK(order.tasks > 2 * order.calls);  // where flags are atomic
        g.x.back() = std::nan("");
        for (double const value : adjoint(solved.basis, g, &executor)) CHECK(std::isnan(value));
        g.x.back() = 0;
        g.y[0] = HUGE_VAL;
        for (double const value : adjoint(solved.basis, g, &executor)) CHECK(std::isnan(value));
        g = Gradient(setup.mesh.x.size(), 15);
    }
}

TEST_CASE("rows far from the wall, where all values are small, are scaled like the whole") {
    Case setup = ring_case(20, 40, 0.5, 2);
    Solved const solved(setup);
    std::int32_t const n = setup.mesh.n_points(), outer = n - 80;
    std::vector<std::int32_t> points;
    for (std::int32_t k = outer; k < n; ++k) points.push_back(k);
    Rows const rows(solved.basis, points);
    Numbers const ones(std::size_t(n), 1.0);
    std::int32_t whole = 0, part = 0;
    REQUIRE(hm_private_adjoint_scale(solved.basis, points_in(ones, ones), &whole, nullptr,
                                     nullptr) == HM_OK);
    REQUIRE(hm_private_adjoint_scale(rows.basis, points_in(ones, ones), &part, nullptr, nullptr) ==
            HM_OK);
    CHECK(part == whole);
}

TEST_CASE("more numbers in a row than are summed in one block") {
    Case setup = ring_case(3, 150, 0.5, 2, Cells::quads, 3, 150);
    Solved const solved(setup);
    Gradient const g(setup.mesh.x.size(), 7);
    CHECK(same_bits(adjoint_in_parts(solved.basis, g, random_parts(setup.mesh.n_points(), 3, 4)),
                    adjoint(solved.basis, g)));
}

TEST_CASE("a gradient times a power of two has the same bits times this power") {
    Case setup = two_body_case();
    Solved const solved(setup);
    Gradient const g(setup.mesh.x.size(), 9);
    Numbers const expected = adjoint(solved.basis, g);
    for (int const e : {-900, -40, 1, 60, 1000}) {
        Gradient scaled = g;
        for (Numbers* const list : {&scaled.x, &scaled.y})
            for (double& value : *list) value = std::ldexp(value, e);
        Numbers found = adjoint(solved.basis, scaled);
        for (double& value : found) value = std::ldexp(value, -e);
        CHECK(same_bits(found, expected));
    }
}

TEST_CASE("one number that is not finite makes the gradient NaN, wherever it is") {
    Untrapped const untrapped;
    Case setup = two_body_case();
    Solved const solved(setup);
    for (double const bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        Gradient g(setup.mesh.x.size(), 11);
        g.y[5] = bad;
        for (double const value : adjoint(solved.basis, g)) CHECK(std::isnan(value));
        for (double const value :
             adjoint_in_parts(solved.basis, g, random_parts(setup.mesh.n_points(), 3, 2)))
            CHECK(std::isnan(value));
    }
    Gradient zero(setup.mesh.x.size(), 12);
    std::fill(zero.x.begin(), zero.x.end(), 0.0);
    zero.y = zero.x;
    for (double const value : adjoint(solved.basis, zero)) {
        CHECK(value == 0);
        CHECK(!std::signbit(value));
    }
}

TEST_CASE("scales that do not fit are refused") {
    Case setup = two_body_case();
    Solved const solved(setup);
    Gradient const g(setup.mesh.x.size(), 13);
    std::vector<std::int64_t> sums(80);
    Numbers gradient(40);
    std::int32_t scale = 0;
    hm_error error{};
    REQUIRE(hm_private_adjoint_scale(solved.basis, points_in(g.x, g.y), &scale, nullptr, nullptr) ==
            HM_OK);
    auto const sum_at = [&](std::int32_t at) {
        return hm_private_adjoint_sums(solved.basis, points_in(g.x, g.y), at, sums.data(), nullptr,
                                       &error);
    };
    CHECK(sum_at(scale) == HM_OK);
    CHECK(sum_at(scale + 1) == HM_OK);
    CHECK(sum_at(scale - 1) == HM_BAD_ARGUMENT);
    CHECK(error.item == scale - 1);
    for (std::int32_t const absurd : {5000, -5000}) {
        CHECK(sum_at(absurd) == HM_BAD_ARGUMENT);
        CHECK(hm_private_adjoint_finish(solved.basis, absurd, sums.data(), gradient.data(),
                                        &error) == HM_BAD_ARGUMENT);
    }
}
