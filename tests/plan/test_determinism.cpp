// Same input, same bits: again, in any order of calls, and whatever lay in the memory before.
#include "fixtures/options.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>

#include <harmorph_pthreads.h>

using namespace fixtures;

namespace {

std::vector<unsigned char> bytes_of(const hm_basis* basis) {
    auto info = sized<hm_basis_info>();
    REQUIRE(hm_basis_info_get(basis, &info, nullptr) == HM_OK);
    const unsigned char* const begin = reinterpret_cast<const unsigned char*>(basis);
    return {begin, begin + info.bytes};
}

}  // namespace

TEST_CASE("a basis solved twice is the same block, byte by byte, even between its arrays") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = airfoil_case(40, 12, kind);
        Solved const a(setup), b(setup);
        CHECK(bytes_of(a.basis) == bytes_of(b.basis));
        CHECK(a.report.residual == b.report.residual);
        CHECK(a.report.boundary_error == b.report.boundary_error);
    }
}

TEST_CASE("what lay in the blocks before does not matter") {
    Case setup = two_body_case();
    Options usual{};
    Solved const reference(setup, &usual);
    hm_problem const problem = setup.problem();
    for (int const garbage : {0x00, 0xFF, 0x7F, 0x3F}) {
        std::vector<unsigned char> blocks[3];
        std::size_t bytes = 0;
        hm_analysis* analysis = nullptr;
        hm_plan* plan = nullptr;
        hm_basis* basis = nullptr;
        auto const block = [&](int which) {
            blocks[which].assign(bytes, static_cast<unsigned char>(garbage));
            return blocks[which].data();
        };
        REQUIRE(hm_analysis_size(&problem, nullptr, &bytes, nullptr) == HM_OK);
        REQUIRE(hm_analysis_init(&analysis, block(0), bytes, &problem, nullptr, nullptr) == HM_OK);
        REQUIRE(hm_plan_size(analysis, &bytes, nullptr) == HM_OK);
        REQUIRE(hm_plan_init(&plan, block(1), bytes, analysis, nullptr) == HM_OK);
        REQUIRE(hm_basis_size(analysis, &bytes, nullptr) == HM_OK);
        REQUIRE(hm_basis_init(&basis, block(2), bytes, analysis, nullptr) == HM_OK);
        // The analysis is given back.
        std::fill(blocks[0].begin(), blocks[0].end(), static_cast<unsigned char>(~garbage));
        REQUIRE(hm_plan_factor(plan, nullptr, nullptr) == HM_OK);
        REQUIRE(hm_plan_solve(plan, basis, nullptr, nullptr) == HM_OK);
        CHECK(bytes_of(basis) == bytes_of(reference.basis));
    }
}

TEST_CASE("two plans step by step in turn do not disturb each other") {
    Case first = airfoil_case(), second = two_body_case();
    Solved const a(first), b(second);
    Attempt c, d;
    REQUIRE(c.analyse(first.problem()));
    REQUIRE(d.analyse(second.problem()));
    REQUIRE(c.prepare());
    REQUIRE(d.prepare());
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
    Solved const reference(setup);
    std::vector<double> const expected = reference.all_values();
    int tried = 0;
    for (std::int32_t const kernel :
         {HM_KERNEL_BASELINE, HM_KERNEL_AVX2, HM_KERNEL_AVX512, HM_KERNEL_NEON}) {
        auto executor = sized<hm_executor>();
        executor.kernel = kernel;
        Options options = laplace();
        options.executor = &executor;
        Attempt const first(setup.problem(), &options);
        if (first.status == HM_UNSUPPORTED) continue;
        ++tried;
        Solved const a(setup.problem(), &options), b(setup.problem(), &options);
        CHECK(bytes_of(a.basis) == bytes_of(b.basis));
        CHECK(largest_difference(a.all_values(), expected) < 1e-11);
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
