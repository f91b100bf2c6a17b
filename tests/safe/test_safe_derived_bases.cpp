// Safe morphs by derived bases: combined functions and modes.
#include <fixtures/single.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/displaced.hpp>

using namespace fixtures;

TEST_CASE("large safe morphs by combined functions and by modes are valid and reach the target") {
    Case setup = two_body_case(Cells::hybrid, 12, 8);
    Options const options = options_of(HM_CONFORMAL);
    Safe reference(setup, options);
    hm_basis_info const info = reference.solved().info();
    // Two variables: all control points along x, and along y times their own x.
    Combination matrix(info.control_points, 2, 1, 1);
    for (int i = 0; i < matrix.rows; ++i) {
        auto const k = std::size_t(2 * i);
        matrix.entries[k] = 1;
        matrix.entries[k + 1] = setup.curves.control[k];
    }
    Combined const combined(reference.solved().basis, matrix);
    REQUIRE(combined.status == HM_OK);
    hm_plan* const plan = reference.solved().plan;
    Guarded work = block_of(safe_move_size, plan, combined.basis);
    std::size_t const bytes = work.size();
    CHECK(bytes < block_of(safe_move_size, plan, nullptr).size());
    std::vector<double> move = {0.02, 0, 0, 0.1};
    hm_safe_options safe_options = reference.safe_options;
    safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
    auto report = sized<hm_safe_report>();
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y, reached(move.size());
    safe_options.reached = reached.data();
    hm_error error{};
    Combined const sum(reference.solved().basis, matrix);
    REQUIRE_MESSAGE(safe_move(plan, combined.basis, move.data(), points_out(x, y), sum.basis,
                              work.data(), bytes, &safe_options, &report, &error) == HM_OK,
                    error.text);
    CHECK(report.strategy == HM_STRATEGY_SUBSTEPS);
    CHECK(report.resolves > 0);
    CHECK(reached == move);
    Mesh moved = setup.mesh;
    moved.x = x;
    moved.y = y;
    CHECK(check(moved).min_corner > 0);
    CHECK(boundary_error(combined.basis, move, setup.mesh, moved) < 1e-14);
    // The derivative at the wall is that of the combined functions.
    Moved const slope = displaced(sum.basis, move), expected = displaced(combined.basis, move);
    for (std::int32_t slot = 0; slot < info.curve_points; ++slot) {
        auto const at = std::size_t(info.curve_point[slot]);
        CHECK(slope.x[at] == doctest::Approx(expected.x[at]).epsilon(1e-12));
        CHECK(slope.y[at] == doctest::Approx(expected.y[at]).epsilon(1e-12));
    }
    // The call refuses the derivative of the whole functions.
    CHECK(safe_move(plan, combined.basis, move.data(), points_out(x, y),
                    const_cast<hm_basis*>(reference.solved().basis), work.data(), bytes,
                    &safe_options, nullptr, &error) == HM_BAD_BASIS);

    Case table = setup;
    table.conditions.pop_back();
    table.set_given(second_body);
    Attempt solved(table.problem(), &options);
    REQUIRE(solved.status == HM_OK);
    std::vector<std::int32_t> const points = given_points(solved.plan);
    Field mode;
    for (std::int32_t const point : points) {
        auto const k = std::size_t(point);
        mode.push_back({setup.mesh.y[k], 0.3});
    }
    Tabulated const tabulated(solved.plan, solved.basis, {mode}, 2);
    REQUIRE(tabulated.status == HM_OK);
    Guarded more = block_of(safe_move_size, solved.plan, tabulated.basis);
    std::vector<double> amplitudes(2 * std::size_t(info_of(tabulated.basis).functions));
    amplitudes[amplitudes.size() - 2] = 0.2;
    amplitudes[amplitudes.size() - 1] = 0.1;
    safe_options.reached = nullptr;
    x = setup.mesh.x;
    y = setup.mesh.y;
    REQUIRE_MESSAGE(
        safe_move(solved.plan, tabulated.basis, amplitudes.data(), points_out(x, y), nullptr,
                  more.data(), more.size(), &safe_options, &report, &error) == HM_OK,
        error.text);
    CHECK(report.strategy == HM_STRATEGY_SUBSTEPS);
    moved.x = x;
    moved.y = y;
    CHECK(check(moved).min_corner > 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
        auto const at = std::size_t(points[k]);
        Complex const by = Complex(0.2, 0.1) * mode[k];
        CHECK(std::fabs(x[at] - setup.mesh.x[at] - by.real()) < 1e-15);
        CHECK(std::fabs(y[at] - setup.mesh.y[at] - by.imag()) < 1e-15);
    }
}
