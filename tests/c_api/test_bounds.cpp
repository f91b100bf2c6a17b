// Bounds of the fields of options and of small structs: the last value inside is accepted, the
// first one outside is refused by the field's name.
#include <harmorph_design.h>
#include <harmorph_space.h>
#include "private.h"
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/blocks.hpp>
#include <fixtures/spoiled_arguments.hpp>
#include <fixtures/parted.hpp>

using namespace fixtures;

TEST_CASE("conditions and given parameters") {
    Case setup = tiny_case();
    auto const size = [&](hm_condition const& condition, hm_error* e) {
        hm_problem problem = setup.problem();
        problem.conditions = &condition;
        std::size_t bytes = 0;
        return fixtures::analysis_size(&problem, nullptr, &bytes, e);
    };
    using C = hm_condition;
    check_changes<C>(
        setup.conditions[0],
        {{nullptr, [](C&) {}},
         {nullptr, [](C& c) { c.piece = 1; }},
         {nullptr, [](C& c) { c.piece = 1, c.near_x = 3; }},
         {"piece of condition 0 must be 0 or 1", [](C& c) { c.piece = -1; }},
         {"piece of condition 0 must be 0 or 1", [](C& c) { c.piece = 2; }},
         {"reserved must be 0", [](C& c) { c.reserved = 1; }},
         {"but piece is 0", [](C& c) { c.near_x = 1; }},
         {"but piece is 0", [](C& c) { c.near_y = 1; }},
         {"body of condition 0", [](C& c) { c.body = 1; }},
         {"x or y of condition 0", [](C& c) { c.x = 1; }},
         {"x or y of condition 0", [](C& c) { c.y = 1; }},
         {"partner of condition 0", [](C& c) { c.partner = 1; }},
         {"first_curve or n_curves",
          [](C& c) { c.kind = HM_SLIP, c.n_curves = 0, c.first_curve = 1; }},
         {"a pair of whole markers",
          [](C& c) { c.kind = HM_PERIODIC_PAIR, c.n_curves = 0, c.piece = 1; }},
         {"rigid body 1048576", [](C& c) { c.kind = HM_RIGID, c.n_curves = 0, c.body = 1 << 20; }},
         {"near_x or near_y", [](C& c) { c.piece = 1, c.near_y = beyond_range; }}},
        HM_BAD_CONDITION, size);
    setup.give(16, 0.5);
    auto const size_of = [](hm_problem const& problem, hm_error* e) {
        std::size_t bytes = 0;
        return fixtures::analysis_size(&problem, nullptr, &bytes, e);
    };
    using P = hm_problem;
    check_changes<P>(
        setup.problem(),
        {{nullptr, [](P&) {}},
         {"known_u is NULL, but problem.n_known is 1", [](P& p) { p.known_points = nullptr; }},
         {"known_u is NULL, but problem.n_known is 1", [](P& p) { p.known_curves = nullptr; }},
         {"known_u is NULL, but problem.n_known is 1", [](P& p) { p.known_u = nullptr; }}},
        HM_BAD_ARGUMENT, size_of);
}

TEST_CASE("blocks, and the distances between their points") {
    Blocks const blocks = o_blocks(3, 4, 2, 1, 3);  // 5 x 3 points each, every second one turned
    hm_mesh const mesh = blocks.view();
    std::vector<double> x(blocks.x.size()), y = x;
    hm_points const from{blocks.x.data(), blocks.y.data(), 1};
    auto const scatter = [&](hm_block_points_out const& block, hm_error* e) {
        return hm_blocks_scatter(&mesh, 0, 1, &from, &block, e);
    };
    hm_block_points_out const sound{x.data(), y.data(), 1, 0};
    using B = hm_block_points_out;
    check_changes<B>(
        sound,
        {{nullptr, [](B&) {}},
         {nullptr, [](B& b) { b.row = 5; }},
         {nullptr, [](B& b) { b.stride = 3, b.row = 1; }},
         {"stride or row of block 0", [](B& b) { b.row = 4; }},
         {"stride or row of block 0", [](B& b) { b.stride = 2, b.row = 1; }},
         {"stride or row of block 0", [](B& b) { b.stride = -1; }},
         {"stride or row of block 0", [](B& b) { b.row = -1; }},
         {"stride or row of block 0", [](B& b) { b.stride = (std::int64_t{1} << 40) + 1; }},
         {"stride or row of block 0", [](B& b) { b.row = (std::int64_t{1} << 40) + 1; }},
         {"x or y of block 0", [](B& b) { b.x = nullptr; }},
         {"x or y of block 0", [](B& b) { b.y = nullptr; }}},
        HM_BAD_ARGUMENT, scatter);
    hm_block_points_out all[6] = {sound, sound, sound, sound, sound, sound};
    struct {
        std::int32_t first, n;
        bool exists;
    } const ranges[] = {{0, 6, true},  {5, 1, true},  {0, 0, false},
                        {0, 7, false}, {6, 1, false}, {-1, 1, false}};
    for (auto const& range : ranges) {
        hm_error error{};
        hm_status const status = hm_blocks_scatter(&mesh, range.first, range.n, &from, all, &error);
        INFO(range.first << " " << range.n << ": " << error.text);
        CHECK(status == (range.exists ? HM_OK : HM_BAD_ARGUMENT));
    }
}

TEST_CASE("safe morphs and better cells") {
    static hm_basis const* const nobody = nullptr;
    Case setup = tiny_case();
    Solved const solved(setup);
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y, move(8, 0.0);
    hm_points_out const to{x.data(), y.data(), 1};
    std::size_t bytes = 0;
    Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
    auto const morph = [&](hm_safe_options const& options, hm_error* e) {
        return safe_move(solved.plan, solved.basis, move.data(), &to, nullptr, work.data(),
                         work.size(), &options, nullptr, e);
    };
    using S = hm_safe_options;
    check_changes<S>(
        sized<S>(),
        {{nullptr, [](S&) {}},
         {nullptr, [](S& s) { s.skipped_strategies = (2 << HM_STRATEGY_IMPROVED) - 1 - 1; }},
         {nullptr, [](S& s) { s.max_resolves = -1; }},
         {nullptr, [](S& s) { s.heights = 1, s.min_quality = 1; }},
         {nullptr, [](S& s) { s.min_quality = -1; }},
         {nullptr, [](S& s) { s.max_height_change = 1.001; }},
         {"options.skipped_strategies is -1, but it must be a sum of 1 << HM_STRATEGY_..., that is "
          "between 0 and 31",
          [](S& s) { s.skipped_strategies = -1; }},
         {"skipped_strategies is", [](S& s) { s.skipped_strategies = 2 << HM_STRATEGY_IMPROVED; }},
         {"options.improve must be 0 or 1, not -1", [](S& s) { s.improve = -1; }},
         {"options.improve must be 0 or 1, not 2", [](S& s) { s.improve = 2; }},
         {"options.n_others must be between 0 and 64, not -1", [](S& s) { s.n_others = -1; }},
         {"options.n_others must be between 0 and 64, not 65", [](S& s) { s.n_others = 65; }},
         {"options.others is NULL, but n_others is 1", [](S& s) { s.n_others = 1; }},
         {"basis 0 of options.others is NULL", [](S& s) { s.others = &nobody, s.n_others = 1; }},
         {"options.heights must be between 0 and 1, not 2", [](S& s) { s.heights = 2; }},
         {"options.heights must be between 0 and 1, not -1", [](S& s) { s.heights = -1; }},
         {"options.min_quality must be at most 1, not 2", [](S& s) { s.min_quality = 2; }},
         {"min_quality must be at most 1, not NaN", [](S& s) { s.min_quality = not_a_number; }},
         {"max_height_change must be 0 or above 1, not 1", [](S& s) { s.max_height_change = 1; }},
         {"max_height_change must be 0 or above 1, not -1", [](S& s) { s.max_height_change = -1; }},
         {"options.max_height_change must be 0 or above 1, not NaN",
          [](S& s) { s.max_height_change = not_a_number; }}},
        HM_BAD_ARGUMENT, morph);
    using I = hm_improve_options;
    Guarded room = block_of(fixtures::improve_size, solved.plan);
    hm_points const at{setup.mesh.x.data(), setup.mesh.y.data(), 1};
    auto const improve = [&](I const& options, hm_error* e) {
        return hm_improve(solved.plan, &at, &to, fixtures::Memory(room.data(), room.size()),
                          &options, nullptr, e);
    };
    check_changes<I>(sized<I>(),
                     {{nullptr, [](I&) {}},
                      {nullptr, [](I& i) { i.max_solutions = 10000; }},
                      {"options.max_solutions must be between 0 and 10000, not 10001",
                       [](I& i) { i.max_solutions = 10001; }},
                      {"options.max_solutions must be between 0 and 10000, not -1",
                       [](I& i) { i.max_solutions = -1; }},
                      {"options.reserved must be 0, not 1", [](I& i) { i.reserved = 1; }}},
                     HM_BAD_ARGUMENT, improve);
    hm_error error{};
    CHECK(safe_move(solved.plan, solved.basis, move.data(), &to, solved.basis, work.data(),
                    work.size(), nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "options.derivative and basis must be two different bases");

    // Some of the functions cannot move the mesh, nor be the derivative of its movement.
    hm_basis *share = nullptr, *rest = nullptr;
    REQUIRE(hm_private_share_size(solved.analysis, 0, 2, &bytes, nullptr) == HM_OK);
    Guarded block(bytes), other(bytes);
    REQUIRE(hm_private_share_init(&share, block.data(), bytes, solved.analysis, 0, 2, nullptr) ==
            HM_OK);
    REQUIRE(hm_private_share_init(&rest, other.data(), bytes, solved.analysis, 2, 2, nullptr) ==
            HM_OK);
    REQUIRE(hm_plan_solve(solved.plan, share, nullptr, nullptr) == HM_OK);
    struct {
        hm_basis *basis, *derivative;
    } const pairs[] = {{share, nullptr}, {solved.basis, rest}};
    for (auto const& pair : pairs) {
        CHECK(safe_move(solved.plan, pair.basis, move.data(), &to, pair.derivative, work.data(),
                        work.size(), nullptr, nullptr, &error) == HM_BAD_BASIS);
        CHECK(
            std::string(error.text) ==
            "a basis with a share of the functions cannot move the mesh: all functions are needed");
    }
    CHECK(x == setup.mesh.x);
}

TEST_CASE("levels of a plan") {
    Case setup = two_body_case(Cells::quads, 8, 6);
    Options options = laplace();
    options.engine = HM_FAS;
    Solved const solved(setup, &options);
    std::vector<std::int32_t> cells(setup.mesh.x.size());
    std::int32_t n = 0;
    std::int32_t const levels = solved.report.levels;
    REQUIRE(levels > 0);
    for (std::int32_t const level : {-1, levels + 1}) {
        hm_error error{};
        CHECK(hm_plan_level(solved.plan, level, cells.data(), &n, &error) == HM_BAD_ARGUMENT);
        CHECK(std::string(error.text)
                  .find("there is no level " + std::to_string(level) + "; the plan has ") == 0);
    }
    check_arguments("plan, -, cells, n_cells", hm_plan_level, solved.plan, 0, cells.data(), &n);
}

TEST_CASE("what else a call finds wrong in its numbers") {
    Case setup = tiny_case();
    Solved const solved(setup);
    CurveSet set = airfoil_case().curves;
    std::size_t bytes = 0;
    std::vector<double> values(1000, 0.0), x(48, 0.0), y = x;
    std::vector<std::int32_t> control(8);
    hm_error error{};
    hm_points const points{x.data(), y.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    auto const says = [&](hm_status status, hm_status expected, const char* text) {
        INFO(error.text);
        CHECK(status == expected);
        CHECK(fixtures::says(error, text));
    };
    for (double const u : {not_a_number, HUGE_VAL})
        says(hm_curve_basis(&set.view(), 0, u, 0, control.data(), values.data(), &error),
             HM_BAD_ARGUMENT, "u");
    says(hm_curve_basis(&set.view(), 0, 0.5, -1, control.data(), values.data(), &error),
         HM_BAD_ARGUMENT, "derivatives");
    hm_fit_options few = sized<hm_fit_options>();
    few.n_control = 1;
    const hm_curves* fitted = nullptr;
    says(hm_fit(&fitted, fixtures::Memory(values.data(), 8000), &points, 40, 0, &few, nullptr,
                &error),
         HM_BAD_CURVE, "are too few");

    // Reports and arrays that are not wanted.
    std::int32_t const degree = set.view().curve[0].degree + 1;
    Guarded elevated = block_of(fixtures::refine_size, &set.view(), 0, degree, 0, nullptr);
    CHECK(hm_refine(&fitted, nullptr, fixtures::Memory(elevated.data(), elevated.size()),
                    &set.view(), 0, degree, 0, nullptr, &error) == HM_OK);
    hm_variables naca = sized<hm_variables>();
    naca.kind = HM_NACA4;
    std::int32_t n = 0;
    Guarded work = block_of(fixtures::variables_size, &set.view(), nullptr, &naca, &n);
    CHECK(fixtures::variables_map(&set.view(), nullptr, &naca, nullptr,
                                  fixtures::Memory(work.data(), work.size()), values.data(),
                                  nullptr, &error) == HM_OK);
    // A chord that ends at the origin is a chord.
    hm_section chord = sized<hm_section>();
    chord.trailing_y = -1;
    CHECK(fixtures::variables_map(&set.view(), &chord, &naca, nullptr,
                                  fixtures::Memory(work.data(), work.size()), values.data(),
                                  nullptr, &error) == HM_OK);
    chord.trailing_y = 0, chord.leading_y = -1;
    CHECK(fixtures::variables_map(&set.view(), &chord, &naca, nullptr,
                                  fixtures::Memory(work.data(), work.size()), values.data(),
                                  nullptr, &error) == HM_OK);

    std::int32_t const point = 0;
    says(hm_private_extract_size(solved.basis, -1, &bytes, &error), HM_BAD_ARGUMENT, "-1");
    hm_basis* rows = nullptr;
    says(hm_private_extract_init(&rows, values.data(), 8000, solved.basis, -1, &point, &error),
         HM_BAD_ARGUMENT, "-1");
    says(hm_private_parcel_pack(solved.basis, -1, &point, values.data(), &error), HM_BAD_ARGUMENT,
         "-1");

    hm_mesh broken = setup.mesh_view();
    broken.cell_points = nullptr;
    hm_quality_report quality = sized<hm_quality_report>();
    says(hm_assess(solved.basis, &broken, nullptr, nullptr, nullptr, nullptr, nullptr, &quality,
                   &error),
         HM_BAD_ARGUMENT, "cell_points");

    hm_improve_options improve = sized<hm_improve_options>();
    hm_points const no_y{x.data(), nullptr, 1};
    improve.reference = &no_y;
    Guarded room = block_of(fixtures::improve_size, solved.plan);
    says(hm_improve(solved.plan, &points, &to, fixtures::Memory(room.data(), room.size()), &improve,
                    nullptr, &error),
         HM_BAD_ARGUMENT, "reference.x or reference.y is NULL");
}

TEST_CASE("a given displacement whose target is out of range") {
    Case setup = given_instead(tiny_case());
    Displaced displaced(setup);
    std::int32_t const n = std::int32_t(displaced.points.size());
    std::vector<double> far(setup.mesh.x.size(), 6e99), x = setup.mesh.x, y = setup.mesh.y;
    hm_points const all{far.data(), far.data(), 1};
    hm_points_out const to{x.data(), y.data(), 1};
    Guarded work = displaced.work_for(1);
    hm_error error{};
    CHECK(hm_displace(displaced.plan, n, nullptr, 1, &all, &all, &to,
                      fixtures::Memory(work.data(), work.size()), nullptr,
                      &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text).find("a target coordinate of point ") == 0);
    CHECK(fixtures::says(error, "in field 0 exceeds 1e100 in magnitude"));
    CHECK(x == setup.mesh.x);
}

TEST_CASE("numbers in sentences: integers below 1e15 with all their digits, others with six") {
    Case setup = tiny_case();
    struct {
        double value;
        const char* words;
    } const all[] = {{1, "not 1"},
                     {999999999999999, "not 999999999999999"},
                     {1e15, "not 1.00000e15"},
                     {-999999999999999, "not -999999999999999"},
                     {-1e15, "not -1.00000e15"},
                     {1.5, "not 1.50000"}};
    for (auto const& one : all) {
        Options options = laplace();
        options.tolerance = one.value;
        Attempt const attempt(setup.problem(), &options);
        INFO(attempt.error.text);
        CHECK(attempt.status == HM_BAD_ARGUMENT);
        CHECK(fixtures::says(attempt.error, one.words));
    }
}
