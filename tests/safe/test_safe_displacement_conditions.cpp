// Safe given displacements beside other conditions: curves, design variables, and lines along which
// points slip.
#include <fixtures/single.hpp>
#include <fixtures/channels.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

TEST_CASE("both bodies turn with points beside a curve, and each wall is where it is described") {
    Case setup = two_body_case(Cells::hybrid, 12, 8);
    setup.conditions.pop_back();
    setup.set_given(second_body);
    SafeDisplaced safe(setup, options_of(HM_CONFORMAL));
    REQUIRE(hm_plan_solve(safe.plan, safe.basis, nullptr, nullptr) == HM_OK);
    hm_basis_info const info = info_of(safe.basis);
    Field const start = safe.start();
    Complex centre = 0;
    for (Complex const z : start) centre += z / double(start.size());
    Field const wall = safe.similarity(std::polar(1.0, -50 * pi / 180), centre);
    std::vector<double> move(2 * std::size_t(info.functions));  // the first curve up
    for (std::int32_t const i : setup.curves.shapes[0].indices) move[2 * std::size_t(i) + 1] = 0.03;
    std::vector<double> reached(move.size());
    safe.safe_options.reached = reached.data();
    REQUIRE_MESSAGE(safe.run(wall, &move) == HM_OK, safe.error.text);
    CHECK(safe.is_at(wall));
    CHECK(reached == move);
    double const error = boundary_error(safe.basis, move, safe.mesh, Moved{safe.x, safe.y});
    CHECK(std::fabs(error - safe.safe_report.rotated_offset) < 1e-14);

    // Design variables instead of control points.
    Combination const by(info.control_points, 2, 1, 3);
    Combined const combined(safe.basis, by);
    REQUIRE(combined.status == HM_OK);
    std::vector<double> const few = some_move(2, 0.005, 4);
    safe.safe_options.reached = nullptr;
    CHECK(safe.run(wall, &few, combined.basis) == HM_OK);
    CHECK(safe.is_at(wall));

    // Functions by table move the same points.
    REQUIRE(hm_plan_factor(safe.plan, nullptr, nullptr) == HM_OK);
    Tabulated const tabulated(safe.plan, safe.basis, {Field(start.size(), Complex(1, 0))}, 2);
    REQUIRE(tabulated.status == HM_OK);
    CHECK(safe.run(wall, nullptr, tabulated.basis) == HM_UNSUPPORTED);
}

TEST_CASE("a wall that ends on a slip line goes straight and slips along the line") {
    Case setup = given_instead(half_ring(8, 16, Cells::quads, 0, 4));
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        SafeDisplaced safe(setup, options_of(kind));
        Field const start = safe.start();
        Field wall;
        for (Complex const z : start) wall.push_back(Complex(0.75 * z.real(), -0.4 * z.imag()));
        REQUIRE_MESSAGE(safe.run(wall) == HM_OK, safe.error.text);
        CHECK(safe.is_at(wall));
        for (std::size_t k = 0; k < safe.x.size(); ++k)
            if (setup.mesh.y[k] == 0) CHECK(safe.y[k] == 0);
    }
}
