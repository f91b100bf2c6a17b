// Every block that is too small is refused, and nothing outside of it is touched; exactly the
// stated size suffices.
#include <harmorph_space.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/extruded.hpp>
#include <fixtures/mesh.hpp>
#include <fixtures/operators.hpp>

#include <set>

using namespace fixtures;

namespace {

constexpr std::size_t shifts[] = {0, 1, 8, 40,
                                  63};  // of a block's beginning against a multiple of 64

// Sizes below `need`: all that end near an array's end matter, so go in steps that hit every
// multiple of 64 and its neighbours, every small one, and the last ones.
std::vector<std::size_t> sizes_below(std::size_t need) {
    std::set<std::size_t> sizes;
    for (std::size_t size = 0; size < need && size < 300; ++size) sizes.insert(size);
    std::size_t const step = need / 300 / 64 * 64 + 64;
    for (std::size_t size = 0; size < need; size += step)
        for (std::size_t near : {size, size + 1, size + 63})
            if (near < need) sizes.insert(near);
    for (std::size_t short_of = 1; short_of <= 130 && short_of <= need; ++short_of)
        sizes.insert(need - short_of);
    return {sizes.begin(), sizes.end()};
}

// Calls init(&object, block, bytes, error) for each size at several misalignments, and use(object)
// where the block suffices.
template <class Object, class Init, class Use>
void starve(std::size_t need, Init const& init, Use const& use) {
    REQUIRE(need > 200);
    auto const call = [&](Guarded& block, hm_error& error) {
        Object* object = nullptr;
        hm_status const status = init(&object, block.data(), block.size(), &error);
        CHECK((object != nullptr) == (status >= 0));
        if (status >= 0) use(object);
        return status;
    };
    for (std::size_t const shift : shifts) {
        for (std::size_t const size : sizes_below(need)) {
            Guarded block(size, shift);
            hm_error error{};
            INFO("size " << size << " of " << need << ", shift " << shift);
            CHECK(call(block, error) == HM_BLOCK_TOO_SMALL);
            CHECK(error.value == double(need - size));
            CHECK(block.untouched());
        }
        Guarded block(need, shift);
        hm_error error{};
        CHECK(call(block, error) >= 0);
        CHECK(block.guards_intact());
    }
}

}  // namespace

TEST_CASE("analysis, plan and basis: every size below the required one is refused") {
    Case setup = two_body_case(Cells::hybrid, 4, 3);
    Mixed const mixed(setup.mesh);
    hm_mesh const in_two_arrays = mixed.put_into(mixed.rows.view());
    for (bool const with_curves : {true, false}) {
        hm_problem problem = with_curves ? setup.problem() : setup.problem(in_two_arrays);
        if (!with_curves) problem.curves = nullptr;
        starve<hm_analysis>(
            block_of(fixtures::analysis_size, &problem, nullptr).size(),
            [&](hm_analysis** analysis, void* block, std::size_t bytes, hm_error* e) {
                return hm_analysis_init(analysis, fixtures::Memory(block, bytes), &problem, nullptr,
                                        e);
            },
            [](hm_analysis*) {});
    }
    for (std::int32_t const engine : {HM_DIRECT, HM_MULTIGRID}) {
        Options options = options_of(HM_CONFORMAL);
        options.engine = engine;
        Solved const solved(setup, options);
        starve<hm_plan>(
            block_of(fixtures::plan_size, solved.analysis).size(),
            [&](hm_plan** plan, void* block, std::size_t bytes, hm_error* e) {
                return hm_plan_init(plan, fixtures::Memory(block, bytes), solved.analysis, e);
            },
            [&](hm_plan* plan) {
                REQUIRE(hm_plan_factor(plan, nullptr, nullptr) == HM_OK);
                REQUIRE(hm_plan_solve(plan, solved.basis, nullptr, nullptr) == HM_OK);
            });
        starve<hm_basis>(
            block_of(fixtures::basis_size, solved.analysis).size(),
            [&](hm_basis** basis, void* block, std::size_t bytes, hm_error* e) {
                return hm_basis_init(basis, fixtures::Memory(block, bytes), solved.analysis, e);
            },
            [&](hm_basis* basis) {
                REQUIRE(hm_plan_solve(solved.plan, basis, nullptr, nullptr) == HM_OK);
            });
    }
}

TEST_CASE("fit: every size below the required one is refused") {
    std::vector<harmorph::Vec2> const points = naca({0, 0.4, 0.12, true}, 30);
    auto const n = std::int32_t(points.size());
    auto options = sized<hm_fit_options>();
    options.n_control = 12;
    starve<const hm_curves>(
        block_of(fixtures::fit_size, n, &options).size(),
        [&](const hm_curves** curves, void* block, std::size_t bytes, hm_error* e) {
            return hm_fit(curves, fixtures::Memory(block, bytes),
                          points_in(&points[0].x, &points[0].y, 2), n, 1, &options, nullptr, e);
        },
        [](const hm_curves*) {});
}

TEST_CASE("plane: every size below the required one is refused, and the smallest block suffices") {
    Case setup = tiny_case();
    Solved const solved(setup);
    std::vector<double> const move = some_move(4, 0.1, 1);
    for (Placement const& place : {along_axis(1), wedge(5)}) {
        Extruded const space(setup.mesh, place, 2);
        hm_space_mesh const view = space.view();
        starve<hm_plane>(
            block_of(fixtures::plane_size, &view).size(),
            [&](hm_plane** plane, void* block, std::size_t bytes, hm_error* e) {
                return hm_plane_init(plane, fixtures::Memory(block, bytes), &view, e);
            },
            [&](hm_plane* plane) {
                std::vector<double> x = space.x, y = space.y, z = space.z, gradient(8);
                hm_space_points const from = space.points();
                hm_space_points_out const to{x.data(), y.data(), z.data(), 1};
                REQUIRE(hm_plane_morph(plane, solved.basis, move.data(), &from, &to, nullptr,
                                       nullptr) == HM_OK);
                REQUIRE(hm_plane_adjoint(plane, solved.basis, &from, gradient.data(), nullptr,
                                         nullptr) == HM_OK);
            });
    }
}

TEST_CASE("blocks of exactly the stated size suffice at every alignment on every kind of mesh") {
    // Guards are checked after the solution: no kernel writes past its block, whatever the sizes of
    // its fronts.
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (int const n : {4, 7, 8, 9, 17}) {
            Case setup = ring_case(7, 24, 0.5, 2, kind, 2, n);
            hm_problem const problem = setup.problem();
            std::vector<double> first;
            for (std::size_t const shift : shifts) {
                Attempt attempt;
                REQUIRE(attempt.analyse(problem, nullptr, shift));
                REQUIRE(attempt.prepare(shift));
                REQUIRE(attempt.solve());
                CHECK(attempt.guards_intact());
                std::vector<double> const values = values_of(attempt.basis, 2);
                if (first.empty()) first = values;
                CHECK(same_bits(first, values));
            }
        }
}

TEST_CASE("blocks for several threads: exactly the stated size, and one byte less is refused") {
    Case setup = two_body_case(Cells::hybrid, 14, 10);
    for (std::int32_t const threads : {2, 5, 64}) {
        Backwards order;
        hm_executor const executor = order.executor(threads);
        Options options = laplace();
        options.executor = &executor;
        hm_problem const problem = setup.problem();
        for (std::size_t const shift : shifts) {
            Attempt attempt;
            REQUIRE(attempt.analyse(problem, &options, shift));
            REQUIRE(attempt.prepare(shift));
            REQUIRE(attempt.solve());
            CHECK(attempt.guards_intact());
            CHECK(attempt.report.residual < 1e-12);
            hm_plan* plan = nullptr;
            Guarded less(attempt.plan_block->size() - 1, shift);
            CHECK(hm_plan_init(&plan, fixtures::Memory(less.data(), less.size()), attempt.analysis,
                               nullptr) == HM_BLOCK_TOO_SMALL);
            CHECK(plan == nullptr);
            CHECK(less.untouched());
            hm_analysis* analysis = nullptr;
            Guarded small(attempt.analysis_block->size() - 1, shift);
            CHECK(hm_analysis_init(&analysis, fixtures::Memory(small.data(), small.size()),
                                   &problem, &options, nullptr) == HM_BLOCK_TOO_SMALL);
            CHECK(analysis == nullptr);
            CHECK(small.untouched());
        }
    }
}

TEST_CASE("sizes follow from the counts alone, and do not depend on where anything lies") {
    Case setup = airfoil_case();
    hm_problem problem = setup.problem();
    std::size_t a = 0, b = 0;
    REQUIRE(fixtures::analysis_size(&problem, nullptr, &a, nullptr) == HM_OK);
    Case other = setup;
    renumber_points(other.mesh, 1);
    problem = other.problem();
    REQUIRE(fixtures::analysis_size(&problem, nullptr, &b, nullptr) == HM_OK);
    CHECK(a == b);
    hm_mesh no_arrays = other.mesh.view();
    no_arrays.points = {};
    no_arrays.cell_points = no_arrays.cell_start = no_arrays.face_points = nullptr;
    problem.mesh = &no_arrays;
    REQUIRE(fixtures::analysis_size(&problem, nullptr, &b, nullptr) == HM_OK);
    CHECK(a == b);
}
