// Every block that is too small is refused, and nothing outside of it is touched; exactly the
// stated size suffices.
#include <harmorph_space.h>
#include <harmorph_study.h>
#include "fixtures/options.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/extruded.hpp>
#include <fixtures/mixed.hpp>

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

// init(block, bytes, error) for each size at several misalignments.
template <class Init>
void starve(std::size_t need, Init init) {
    REQUIRE(need > 200);
    for (std::size_t const shift : shifts) {
        for (std::size_t const size : sizes_below(need)) {
            Guarded block(size, shift);
            hm_error error{};
            INFO("size " << size << " of " << need << ", shift " << shift);
            CHECK(init(block.data(), size, error) == HM_BLOCK_TOO_SMALL);
            CHECK(error.value == static_cast<double>(need - size));
            CHECK(block.untouched());
        }
        Guarded block(need, shift);
        hm_error error{};
        CHECK(init(block.data(), need, error) >= 0);
        CHECK(block.guards_intact());
    }
}

}  // namespace

TEST_CASE("analysis: with curves and without, at every size below the required one") {
    Case setup = two_body_case(Cells::hybrid, 4, 3);
    Mixed const mixed(setup.mesh);
    hm_mesh const in_two_arrays = mixed.put_into(mixed.rows.view());
    for (bool const with_curves : {true, false}) {
        hm_problem problem = with_curves ? setup.problem() : setup.problem(in_two_arrays);
        if (!with_curves) problem.curves = nullptr;
        std::size_t need = 0;
        REQUIRE(hm_analysis_size(&problem, nullptr, &need, nullptr) == HM_OK);
        starve(need, [&](void* block, std::size_t bytes, hm_error& error) {
            hm_analysis* analysis = nullptr;
            hm_status const status =
                hm_analysis_init(&analysis, block, bytes, &problem, nullptr, &error);
            CHECK((analysis != nullptr) == (status >= 0));
            return status;
        });
    }
}

TEST_CASE("plan: at every size below the required one; the smallest block solves") {
    Case setup = two_body_case(Cells::hybrid, 4, 3);
    for (std::int32_t const engine : {std::int32_t{HM_DIRECT}, std::int32_t{HM_MULTIGRID}}) {
        Options options = options_of(HM_CONFORMAL);
        options.engine = engine;
        Attempt reference(setup.problem(), &options);
        REQUIRE(reference.status == HM_OK);
        std::size_t need = 0;
        REQUIRE(hm_plan_size(reference.analysis, &need, nullptr) == HM_OK);
        starve(need, [&](void* block, std::size_t bytes, hm_error& error) {
            hm_plan* plan = nullptr;
            hm_status const status = hm_plan_init(&plan, block, bytes, reference.analysis, &error);
            CHECK((plan != nullptr) == (status >= 0));
            if (status >= 0) {
                REQUIRE(hm_plan_factor(plan, nullptr, nullptr) == HM_OK);
                REQUIRE(hm_plan_solve(plan, reference.basis, nullptr, nullptr) == HM_OK);
            }
            return status;
        });
    }
}

TEST_CASE("basis: at every size below the required one; the smallest block holds the solution") {
    Case setup = two_body_case(Cells::hybrid, 4, 3);
    Attempt reference(setup.problem());
    REQUIRE(reference.status == HM_OK);
    std::size_t need = 0;
    REQUIRE(hm_basis_size(reference.analysis, &need, nullptr) == HM_OK);
    starve(need, [&](void* block, std::size_t bytes, hm_error& error) {
        hm_basis* basis = nullptr;
        hm_status const status = hm_basis_init(&basis, block, bytes, reference.analysis, &error);
        CHECK((basis != nullptr) == (status >= 0));
        if (status >= 0) REQUIRE(hm_plan_solve(reference.plan, basis, nullptr, nullptr) == HM_OK);
        return status;
    });
}

TEST_CASE("fit: at every size below the required one") {
    Naca4 naca;
    naca.blunt = true;
    Outline const outline = naca4(naca, 30);
    double const* const xy = &outline.points[0].x;
    std::int32_t const n = static_cast<std::int32_t>(outline.points.size());
    auto options = sized<hm_fit_options>();
    options.n_control = 12;
    std::size_t need = 0;
    REQUIRE(hm_fit_size(n, &options, &need, nullptr) == HM_OK);
    starve(need, [&](void* block, std::size_t bytes, hm_error& error) {
        const hm_curves* curves = nullptr;
        hm_status const status = hm_fit(&curves, block, bytes, points_in(xy, xy + 1, 2), n, 1,
                                        &options, nullptr, &error);
        CHECK((curves != nullptr) == (status >= 0));
        return status;
    });
}

TEST_CASE("plane: at every size below the required one; the smallest block moves all points") {
    Case setup = tiny_case();
    Solved const solved(setup);
    std::vector<double> const move = some_move(4, 0.1, 1);
    for (Placement const& place : {along_axis(1), wedge(5)}) {
        Extruded const space(setup.mesh, place, 2);
        hm_space_mesh const view = space.view();
        std::size_t need = 0;
        REQUIRE(hm_plane_size(&view, &need, nullptr) == HM_OK);
        starve(need, [&](void* block, std::size_t bytes, hm_error& error) {
            hm_plane* plane = nullptr;
            hm_status const status = hm_plane_init(&plane, block, bytes, &view, &error);
            CHECK((plane != nullptr) == (status >= 0));
            if (status < 0) return status;
            std::vector<double> x = space.x, y = space.y, z = space.z, gradient(8);
            hm_space_points const from = space.points();
            hm_space_points_out const to{x.data(), y.data(), z.data(), 1};
            REQUIRE(hm_plane_morph(plane, solved.basis, move.data(), &from, &to, nullptr,
                                   nullptr) == HM_OK);
            REQUIRE(hm_plane_adjoint(plane, solved.basis, &from, gradient.data(), nullptr,
                                     nullptr) == HM_OK);
            return status;
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
                std::vector<double> values(static_cast<std::size_t>(setup.mesh.n_points()));
                REQUIRE(hm_basis_values(attempt.basis, 2, 0, values.data(), nullptr) == HM_OK);
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
            CHECK(hm_plan_init(&plan, less.data(), less.size(), attempt.analysis, nullptr) ==
                  HM_BLOCK_TOO_SMALL);
            CHECK(plan == nullptr);
            CHECK(less.untouched());
            hm_analysis* analysis = nullptr;
            Guarded small(attempt.analysis_block->size() - 1, shift);
            CHECK(hm_analysis_init(&analysis, small.data(), small.size(), &problem, &options,
                                   nullptr) == HM_BLOCK_TOO_SMALL);
            CHECK(analysis == nullptr);
            CHECK(small.untouched());
        }
    }
}

TEST_CASE("sizes follow from the counts alone, and do not depend on where anything lies") {
    Case setup = airfoil_case();
    hm_problem problem = setup.problem();
    std::size_t a = 0, b = 0;
    REQUIRE(hm_analysis_size(&problem, nullptr, &a, nullptr) == HM_OK);
    Case other = setup;
    renumber_points(other.mesh, 1);
    problem = other.problem();
    REQUIRE(hm_analysis_size(&problem, nullptr, &b, nullptr) == HM_OK);
    CHECK(a == b);
    hm_mesh no_arrays = other.mesh.view();
    no_arrays.points = {};
    no_arrays.cell_points = no_arrays.cell_start = no_arrays.face_points = nullptr;
    problem.mesh = &no_arrays;
    REQUIRE(hm_analysis_size(&problem, nullptr, &b, nullptr) == HM_OK);
    CHECK(a == b);
}
