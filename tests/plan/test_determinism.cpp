// Same input, same bits: again, in any order of calls, and whatever lay in the memory before.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/single.hpp>

#include <harmorph_pthreads.h>

using namespace fixtures;

TEST_CASE("two plans step by step in turn do not disturb each other") {
    Case first = airfoil_case(), second = two_body_case();
    Solved const a(first), b(second);
    Attempt c = prepared(first.problem()), d = prepared(second.problem());
    REQUIRE(hm_plan_factor(c.plan, nullptr, nullptr) == HM_OK);
    REQUIRE(hm_plan_factor(d.plan, nullptr, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(c.plan, c.basis, nullptr, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(d.plan, d.basis, nullptr, nullptr) == HM_OK);
    CHECK(bytes_of(c.basis) == bytes_of(a.basis));
    CHECK(bytes_of(d.basis) == bytes_of(b.basis));
}

TEST_CASE("factoring and solving again, also after other coordinates, gives the same bits") {
    Case setup = airfoil_case();
    Solved const solved(setup);
    std::vector<unsigned char> const expected = bytes_of(solved.basis);
    REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
    CHECK(bytes_of(solved.basis) == expected);
    Mesh moved = setup.mesh;
    perturb(moved, 0.1, 3);
    REQUIRE(hm_plan_factor(solved.plan, points_in(moved.x, moved.y), nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
    CHECK(bytes_of(solved.basis) != expected);
    REQUIRE(hm_plan_factor(solved.plan, nullptr, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
    CHECK(bytes_of(solved.basis) == expected);
}

TEST_CASE("kernels agree to rounding, each with itself to the bit") {
    Case setup = airfoil_case();
    int tried = 0;
    for (std::int32_t const operator_kind : {HM_LAPLACE, HM_CONFORMAL})
        for (std::int32_t const kernel :
             {HM_KERNEL_BASELINE, HM_KERNEL_AVX2, HM_KERNEL_AVX512, HM_KERNEL_NEON}) {
            auto executor = sized<hm_executor>();
            executor.kernel = kernel;
            Options options = options_of(operator_kind);
            std::vector<double> const expected = Solved(setup, &options).all_values();
            options.executor = &executor;
            Attempt const first(setup.problem(), &options);
            if (first.status == HM_UNSUPPORTED) {
                CHECK(says(first.error, "a kernel that this processor lacks"));
                continue;
            }
            ++tried;
            Solved const a(setup.problem(), &options), b(setup.problem(), &options);
            CHECK(bytes_of(a.basis) == bytes_of(b.basis));
            CHECK(largest_difference(a.all_values(), expected) < 1e-10);
        }
    CHECK(tried >= 1);
}

TEST_CASE("any number of threads in any order of tasks gives the same bits in all calls") {
    Case setup = ring_case(70, 300, 0.5, 2, Cells::hybrid, 3, 20);  // large enough to be shared out
    perturb(setup.mesh, 0.2, 5);
    hm_mesh const mesh = setup.mesh.view();
    std::vector<double> const move = some_move(20, 0.02, 6),
                              g = some_move(setup.mesh.n_points(), 1, 7);
    std::size_t const n = setup.mesh.x.size();
    std::vector<unsigned char> expected;
    std::vector<double> products;
    for (std::int32_t const threads : {1, 2, 3, 8, 256}) {
        Backwards order;
        hm_executor const executor = order.executor(threads);
        Options options = laplace();
        options.executor = &executor;
        Solved const solved(setup.problem(mesh), &options);
        CHECK((threads > 1) == (order.calls > 0));
        if (expected.empty()) expected = bytes_of(solved.basis);
        CHECK(bytes_of(solved.basis) == expected);

        std::vector<double> found(2 * n), gradient(40);
        auto step = sized<hm_step_report>();
        auto quality = sized<hm_quality_report>();
        REQUIRE(hm_morph(solved.basis, move.data(), nullptr, points_out(&found[0], &found[n]),
                         &executor, nullptr) == HM_OK);
        REQUIRE(hm_adjoint(solved.basis, points_in(g.data(), g.data() + 1, 2), gradient.data(),
                           &executor, nullptr) == HM_OK);
        REQUIRE(hm_assess(solved.basis, &mesh, nullptr, points_in(&found[0], &found[n]), nullptr,
                          &executor, &step, nullptr, nullptr) == HM_OK);
        REQUIRE(hm_assess(solved.basis, &mesh, &mesh.points, nullptr, nullptr, &executor, nullptr,
                          &quality, nullptr) == HM_OK);
        found.insert(found.end(), gradient.begin(), gradient.end());
        found.insert(found.end(),
                     {step.admissible, 1.0 * step.cell, 1.0 * step.point, quality.min_quality,
                      quality.mean_quality, quality.min_area, 1.0 * quality.min_quality_cell});
        if (products.empty()) products = found;
        CHECK(same_bits(found, products));
    }
}

TEST_CASE("real threads, which share out their work anew each time: the same bits") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        Case setup = ring_case(70, 300, 0.5, 2, Cells::hybrid, 3, 20);
        perturb(setup.mesh, 0.2, 5);
        hm_mesh const mesh = setup.mesh.view();
        Options options = laplace();
        options.operator_kind = kind;
        std::vector<unsigned char> const expected =
            bytes_of(Solved(setup.problem(mesh), &options).basis);
        for (std::int32_t const threads : {2, 3, 8}) {
            hm_pthreads pool;
            hm_executor const executor = hm_pthreads_start(&pool, threads);
            options.executor = &executor;
            for (int again = 0; again < 3; ++again) {
                Solved const solved(setup.problem(mesh), &options);
                CHECK(bytes_of(solved.basis) == expected);
            }
            options.executor = nullptr;
            hm_pthreads_stop(&pool);
        }
    }
}
