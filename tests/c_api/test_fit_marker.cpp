// Curves through the walls of a mesh: found, ordered and fitted by one call.
#include <doctest/doctest.h>
#include <harmorph_design.h>

#include <fixtures/bodies.hpp>
#include <fixtures/memory.hpp>

#include <cmath>

using namespace fixtures;

namespace {

struct WallFit {
    std::vector<unsigned char> block;
    const hm_curves* curves = nullptr;
    hm_fit_report report{};
    hm_error error{};
    hm_status status;

    WallFit(hm_mesh const& mesh, std::vector<std::int32_t> const& markers,
            std::int32_t n_control = 12, std::size_t missing = 0) {
        hm_fit_options options;
        HM_INIT(options);
        HM_INIT(report);
        options.n_control = n_control;
        std::size_t bytes = 0;
        auto const n = std::int32_t(markers.size());
        status = fixtures::fit_marker_size(&mesh, n, markers.data(), &options, &bytes, &error);
        if (status < 0) return;
        block.resize(bytes - missing);
        status = hm_fit_marker(&curves, fixtures::Memory(block.data(), block.size()), &mesh, n,
                               markers.data(), &options, &report, &error);
    }
};

}  // namespace

TEST_CASE("the walls of two bodies, on markers of their own or on one, are two pieces") {
    Case setup = two_body_case(Cells::quads, 24, 6);
    hm_mesh const mesh = setup.mesh.view();
    std::vector<std::int32_t> walls;
    for (hm_condition const& condition : setup.conditions) walls.push_back(condition.marker);
    REQUIRE(walls.size() == 2);
    WallFit const both(mesh, walls), first(mesh, {walls[0]}), second(mesh, {walls[1]});
    INFO(both.error.text);
    REQUIRE(both.status == HM_OK);
    REQUIRE(first.status == HM_OK);
    REQUIRE(second.status == HM_OK);
    CHECK(both.report.pieces == 2);
    CHECK(first.report.pieces == 1);
    CHECK(both.curves->n_control == first.curves->n_control + second.curves->n_control);
    CHECK(both.report.max_error == std::max(first.report.max_error, second.report.max_error));
    CHECK(hm_curves_check(both.curves, nullptr) == HM_OK);
    // The problem with these curves is solved, with every wall point near its curve.
    hm_problem problem = setup.problem(mesh);
    problem.curves = both.curves;
    hm_condition conditions[2] = {setup.conditions[0], setup.conditions[1]};
    for (std::int32_t k = 0; k < 2; ++k) {
        conditions[k].first_curve = 0;
        conditions[k].n_curves = both.curves->n_curves;
    }
    problem.conditions = conditions;
    Solved const solved(problem);
    CHECK(solved.report.max_distance <= both.report.max_error * (1 + 1e-12));
    CHECK(solved.report.partition_defect < 1e-13);
}

TEST_CASE("unknown markers, few points and short blocks are refused, and nothing is made") {
    Case setup = two_body_case(Cells::quads, 24, 6);
    hm_mesh const mesh = setup.mesh.view();
    std::int32_t const wall = setup.conditions[0].marker;
    CHECK(WallFit(mesh, {12345}).status == HM_BAD_CONDITION);
    WallFit const second_unknown(mesh, {wall, 12345});
    CHECK(second_unknown.status == HM_BAD_CONDITION);
    CHECK(second_unknown.error.item_kind == HM_ITEM_MARKER);
    CHECK(second_unknown.error.item == 12345);
    CHECK(WallFit(mesh, {}).status == HM_BAD_ARGUMENT);
    CHECK(WallFit(mesh, {wall}, 1000).status == HM_BAD_CURVE);
    CHECK(WallFit(mesh, {wall}, 3).status == HM_BAD_CURVE);
    WallFit const short_block(mesh, {wall}, 12, 64);
    CHECK(short_block.status == HM_BLOCK_TOO_SMALL);
    CHECK(short_block.curves == nullptr);
}

TEST_CASE("only the bytes of the report are needed afterwards, and they are few") {
    Case setup = two_body_case(Cells::quads, 24, 6);
    hm_mesh const mesh = setup.mesh.view();
    std::vector<std::int32_t> walls;
    for (hm_condition const& condition : setup.conditions) walls.push_back(condition.marker);
    for (std::int32_t const n_control : {6, 12}) {
        WallFit one(mesh, walls, n_control), other(mesh, walls, n_control);
        REQUIRE(one.status == HM_OK);
        std::size_t const kept = one.report.bytes;
        CHECK(kept < one.block.size() / 4);
        for (std::size_t k = kept; k < one.block.size(); ++k) one.block[k] = 0xAB;
        CHECK(hm_curves_check(one.curves, nullptr) == HM_OK);
        REQUIRE(one.curves->n_curves == other.curves->n_curves);
        for (std::int32_t k = 0; k < 2 * one.curves->n_control; ++k)
            CHECK(one.curves->control[k] == other.curves->control[k]);
        for (std::int32_t c = 0; c < one.curves->n_curves; ++c) {
            hm_curve const &a = one.curves->curve[c], &b = other.curves->curve[c];
            REQUIRE(a.n_indices == b.n_indices);
            for (std::int32_t k = 0; k < a.n_indices; ++k) CHECK(a.indices[k] == b.indices[k]);
            for (std::int32_t k = 0; k <= a.n_indices + a.degree; ++k)
                CHECK(a.knots[k] == b.knots[k]);
        }
    }
}
