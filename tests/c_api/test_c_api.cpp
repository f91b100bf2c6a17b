// The conventions of the C header: NULL, numbering, error texts, options.
#include <harmorph_design.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/solved.hpp>

#include <set>

using namespace fixtures;

TEST_CASE("versions and names") {
    CHECK(hm_abi_version() == HM_ABI);
    CHECK(std::string(hm_version()) == HM_VERSION);
    CHECK(sizeof(hm_error) == 256);
    std::set<std::string> names;
    for (hm_status status = HM_CROSSING; status <= HM_POOR; ++status)
        names.insert(hm_status_name(status));
    CHECK(names.size() == 17);
    CHECK(names.count("unknown status") == 0);
    CHECK(std::string(hm_status_name(HM_BLOCK_TOO_SMALL)) == "HM_BLOCK_TOO_SMALL");
    CHECK(std::string(hm_status_name(HM_FAR_FROM_POINTS + 1)) == "unknown status");
    CHECK(std::string(hm_status_name(HM_CROSSING - 1)) == "unknown status");
}

TEST_CASE("success clears the error") {
    Case setup = tiny_case();
    hm_problem problem = setup.problem();
    hm_error error{};
    std::size_t bytes = 0;
    CHECK(fixtures::analysis_size(nullptr, nullptr, &bytes, &error) == HM_BAD_ARGUMENT);
    CHECK(error.code == HM_BAD_ARGUMENT);
    CHECK(error.item == -1);
    CHECK(error.text[0] != '\0');
    CHECK(fixtures::analysis_size(&problem, nullptr, &bytes, &error) == HM_OK);
    CHECK(error.code == HM_OK);
    CHECK(error.item == -1);
    CHECK(error.value == 0);
    CHECK(error.text[0] == '\0');
}

TEST_CASE("reports and sentences count as the caller does") {
    for (std::int32_t const base : {0, 1}) {
        Case setup = tiny_case();
        setup.index_base = base;
        Solved const solved(setup);
        hm_mesh const mesh = setup.mesh_view();
        CHECK(solved.info().index_base == base);

        std::int32_t const marker = body;
        std::int32_t points[8], n = 0, is_loop = 0;
        REQUIRE(hm_analysis_boundary(solved.analysis, 1, &marker, 0, points, 8, &n, &is_loop,
                                     nullptr) == HM_OK);
        CHECK(n == 8);
        CHECK(is_loop == 1);
        std::set<std::int32_t> const expected = {16 + base, 17 + base, 18 + base, 23 + base,
                                                 24 + base, 29 + base, 30 + base, 31 + base};
        CHECK(std::set<std::int32_t>(points, points + 8) == expected);

        // The lower left corner's only cell gives way first.
        std::vector<double> d(48, 0.0);
        d[0] = 1;
        hm_step_report const step = step_of(solved.basis, mesh, Moved{d, d});
        CHECK(step.cell == base);
        CHECK(step.point == base);
        CHECK(step.admissible == doctest::Approx(0.5));

        std::vector<double> x = setup.mesh.x;
        x[8] = -1;
        hm_quality_report const quality = quality_of(solved.basis, mesh, Moved{x, setup.mesh.y});
        CHECK(quality.first_inverted == base);
        CHECK(quality.min_quality_cell == base);
        CHECK(quality.crossing_points[0] == -1);

        hm_error error{};
        CHECK(hm_plan_factor(solved.plan, points_in(x.data(), mesh.points.y), &error) ==
              HM_BAD_MESH);
        CHECK(error.item == base);
        CHECK(says(error, base == 0 ? "cell 0 " : "cell 1 "));
        for (double const bad :
             {std::nan(""), HUGE_VAL, -HUGE_VAL}) {  // exceptions are trapped: nothing is computed
            x[8] = bad;
            CHECK(hm_plan_factor(solved.plan, points_in(x.data(), mesh.points.y), &error) ==
                  HM_BAD_MESH);
            CHECK(error.item == base + 8);
        }

        // Control points have a base of their own.
        setup.curves.control[5] = std::nan("");
        CHECK(Attempt(setup.problem()).error.item == 2);
        setup.curves.index_base = 1;
        for (std::int32_t& index : setup.curves.shapes[0].indices) ++index;
        Attempt const attempt(setup.problem());
        CHECK(attempt.status == HM_BAD_CURVE);
        CHECK(attempt.error.item == 3);
        CHECK(says(attempt.error, "control point 3"));
    }
}

TEST_CASE("functions belong to control points whatever those are counted from") {
    Case from_zero = tiny_case(), from_one = from_zero;
    from_one.curves.index_base = 1;
    for (std::int32_t& index : from_one.curves.shapes[0].indices) ++index;
    Solved const a(from_zero), b(from_one);
    CHECK(same_bits(a.all_values(), b.all_values()));
}

TEST_CASE("boundaries by markers: pieces, loops, and room for the points") {
    Case setup = tiny_case();
    hm_problem problem = setup.problem();
    problem.curves = nullptr;
    Attempt attempt;
    REQUIRE(attempt.analyse(problem));
    std::int32_t const sides[] = {bottom, right, top, left}, two[] = {bottom, top};
    std::int32_t points[24], n = -1, is_loop = -1;
    hm_error error{};
    auto const get = [&](std::int32_t n_markers, const std::int32_t* markers, std::int32_t piece,
                         std::int32_t capacity) {
        return hm_analysis_boundary(attempt.analysis, n_markers, markers, piece, points, capacity,
                                    &n, &is_loop, &error);
    };
    REQUIRE(get(4, sides, 0, 24) == HM_OK);
    REQUIRE(n == 24);
    CHECK(is_loop == 1);
    REQUIRE(get(1, sides, 0, 24) == HM_OK);
    REQUIRE(n == 7);  // the mesh on the left
    CHECK(is_loop == 0);
    CHECK(points[0] == 0);
    CHECK(points[6] == 6);
    CHECK(get(1, sides, 1, 24) == HM_BAD_CONDITION);
    std::set<std::int32_t> starts;
    for (std::int32_t const piece : {0, 1}) {
        REQUIRE(get(2, two, piece, 24) == HM_OK);
        REQUIRE(n == 7);
        CHECK(is_loop == 0);
        starts.insert(points[0]);
    }
    CHECK(starts == std::set<std::int32_t>{0, 47});
    CHECK(get(2, two, 2, 24) == HM_BAD_CONDITION);
    CHECK(get(2, two, -1, 24) == HM_BAD_CONDITION);
}
