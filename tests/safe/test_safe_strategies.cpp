// The strategies of the safe morph: cases in which each of them helps, and the properties of each.
#include <fixtures/safe.hpp>

using namespace fixtures;

TEST_CASE("the linear strategy gives the mesh of hm_morph in one step where that is valid") {
    Case setup = block_in_square();
    Safe safe(setup);
    std::vector<double> const move = turn_of(setup, 20);
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.report.strategy == HM_STRATEGY_LINEAR);
    CHECK(safe.report.steps == 1);
    CHECK(safe.report.resolves == 0);
    CHECK(safe.report.step_fraction == 1);
    CHECK(safe.report.other == -1);
    CHECK(safe.report.untangled == 0);
    CHECK(safe.report.admissible == doctest::Approx(safe.admissible(move)));
    CHECK(largest_difference(safe.moved(), displacement(safe.solved(), move)) < 1e-15);
    CHECK(safe.is_valid());
    CHECK(safe.boundary_error(move) < 1e-15);
    REQUIRE(safe.run(std::vector<double>(8, 0.0)) == HM_OK);  // nothing moves
    CHECK(safe.untouched());
    CHECK(safe.report.step_fraction == 1);
    CHECK(safe.is_valid());
}

TEST_CASE("another basis can be the strategy that helps") {
    Case setup = block_in_square();
    Safe safe(setup, options_of(HM_LAPLACE));
    std::vector<double> const move = turn_of(setup, 60);
    CHECK(safe.admissible(move) < 1);
    Solved const useless(setup, options_of(HM_WEIGHTED, 0.25)),
        useful(setup, options_of(HM_CONFORMAL));
    const hm_basis* const others[] = {useless.basis, useful.basis};
    safe.safe_options.n_others = 2;
    safe.safe_options.others = others;
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.report.strategy == HM_STRATEGY_OTHER);
    CHECK(safe.report.other == 1);
    CHECK(safe.report.steps == 1);
    CHECK(largest_difference(safe.moved(), displacement(useful, move)) < 1e-15);
    CHECK(safe.is_valid());
    CHECK(safe.boundary_error(move) < 1e-15);
    Attempt real, derivative;  // a derivative with real values cannot take its complex ones
    Options const paper = options_of(HM_LAPLACE), sharper = options_of(HM_CONFORMAL, 2);
    REQUIRE(real.run(setup.problem(), &paper));
    CHECK(safe.run(move, real.basis) == HM_SHORT);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
    hm_status const beside_others = safe.run(move, real.basis);  // nor can its substeps
    Field const moved_beside_others = safe.moved();
    safe.safe_options.n_others = 0;
    CHECK(safe.run(move, real.basis) == beside_others);
    CHECK(largest_difference(safe.moved(), moved_beside_others) == 0);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    safe.safe_options.n_others = 1;
    safe.safe_options.max_resolves = 10;  // no part of the movement is searched for
    CHECK(safe.run(move) == HM_SHORT);  // with the other one alone: as far as one linear step goes
    CHECK(safe.report.step_fraction == doctest::Approx(0.98 * safe.admissible(move)));
    CHECK(safe.report.strategy == HM_STRATEGY_LINEAR);
    CHECK(safe.report.steps == 1);
    CHECK(safe.is_valid());
    safe.safe_options.skipped_strategies |= without({HM_STRATEGY_LINEAR});
    CHECK(safe.run(move) == HM_SHORT);  // nothing else is allowed
    CHECK(safe.untouched());
    CHECK(safe.report.step_fraction == 0);
    CHECK(safe.report.steps == 0);
    safe.safe_options.skipped_strategies |= without({HM_STRATEGY_OTHER});
    safe.safe_options.n_others = 2;
    CHECK(safe.run(move) == HM_BAD_ARGUMENT);  // nothing at all is allowed
    CHECK(safe.untouched());

    Safe weaker(setup, sharper);  // of the same kind: its functions are the derivative
    weaker.safe_options.n_others = 2;
    weaker.safe_options.others = others;
    weaker.safe_options.skipped_strategies =
        without({HM_STRATEGY_LINEAR, HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    REQUIRE(derivative.run(setup.problem(), &sharper));
    REQUIRE(weaker.run(move, derivative.basis) == HM_OK);
    CHECK(weaker.report.strategy == HM_STRATEGY_OTHER);
    CHECK(weaker.report.other == 1);
    std::vector<double> const further = some_move(4, 1, 7);
    CHECK(largest_difference(displacement(derivative.basis, further),
                             displacement(useful, further)) < 1e-15);
}

TEST_CASE("the longest linear step is straight, without a derivative of a path that turns") {
    Case setup = block_in_square(Cells::quads, 15);
    Options const options = options_of(HM_CONFORMAL);
    Safe safe(setup, options);
    Attempt derivative = prepared(setup.problem(), options);
    std::vector<double> const move = turn_of(setup, 150, {0.05, 0.02});
    REQUIRE(safe.admissible(move) < 1);
    safe.safe_options.skipped_strategies = without(
        {HM_STRATEGY_OTHER, HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
    safe.safe_options.max_resolves = 10;  // no part of the movement is searched for
    CHECK(safe.run(move, derivative.basis) == HM_SHORT);
    CHECK(safe.report.step_fraction == 0);
    CHECK(safe.untouched());
    CHECK(safe.run(move) == HM_SHORT);
    CHECK(safe.report.step_fraction == doctest::Approx(0.98 * safe.admissible(move)));
    CHECK(safe.report.strategy == HM_STRATEGY_LINEAR);
    CHECK(safe.is_valid());
}

TEST_CASE("substeps can be the strategy that helps, with the wall exactly on its B-spline") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = block_in_square(kind);
        Safe safe(setup);
        std::vector<double> const move = turn_of(setup, 120, {0.02, 0.05});
        CHECK(safe.admissible(move) < 1);
        safe.safe_options.skipped_strategies = without({HM_STRATEGY_OTHER, HM_STRATEGY_UNTANGLED});
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.report.strategy == HM_STRATEGY_SUBSTEPS);
        CHECK(safe.report.step_fraction == 1);
        CHECK(safe.report.steps > 1);
        CHECK(safe.report.resolves == safe.report.steps - 1);
        CHECK(safe.report.resolves <= 10);
        CHECK(safe.is_valid());
        CHECK(safe.boundary_error(move) < 1e-15);
        Field const moved = safe.moved();
        for (std::int32_t const side : {bottom, right, top, left})
            for (std::int32_t const point : points_on(setup.mesh, side))
                CHECK(moved[std::size_t(point)] == 0.0);
    }
}

TEST_CASE("a substep takes half of the admissible step, with the functions at its start") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = block_in_square(kind);
        Safe safe(setup);
        safe.safe_options.skipped_strategies = without(
            {HM_STRATEGY_LINEAR, HM_STRATEGY_OTHER, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
        std::vector<double> const shift = similarity_move(setup.curves, 1, {0.5, 0.5}, {0.3, 0.2});
        for (std::vector<double> const& move : {shift, turn_of(setup, 150)}) {
            REQUIRE(safe.admissible(move) < 1);
            Mesh from = setup.mesh;                           // where the substep begins
            for (std::int32_t const resolves : {-1, 1, 2}) {  // -1: no other solution, one substep
                safe.safe_options.max_resolves = resolves;
                REQUIRE(safe.run(move) == HM_SHORT);
                REQUIRE(safe.report.steps == std::max(resolves, 0) + 1);
                Moved by{safe.x, safe.y};
                for (std::size_t k = 0; k < from.x.size(); ++k) {
                    by.x[k] -= from.x[k];
                    by.y[k] -= from.y[k];
                }
                double const steps =  // like this one, until a cell inverts
                    step_of(safe.solved().basis, from.view(), by).admissible;
                INFO("substep " << safe.report.steps << " to " << safe.report.step_fraction
                                << " of the way");
                CHECK(steps >= 2);
                // And no less than half of that, although a turn's way is bent: trials of it
                // overshoot.
                CHECK(steps < 4);
                from = safe.moved_mesh();
            }
        }
        // Straight ahead, the displacements are proportional to the time, so that the search ends
        // at half, or just below.
        safe.safe_options.max_resolves = -1;
        REQUIRE(safe.run(shift) == HM_SHORT);
        CHECK(safe.report.step_fraction <= safe.admissible(shift) / 2);
        CHECK(safe.report.step_fraction > 0.98 * safe.admissible(shift) / 2);
    }
}

TEST_CASE("untangling can be the strategy that helps") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = block_in_square(kind);
        Safe safe(setup);
        std::vector<double> const move = turn_of(setup, 100, {0.05, 0.05});
        CHECK(safe.admissible(move) < 1);
        safe.safe_options.skipped_strategies = without({HM_STRATEGY_OTHER, HM_STRATEGY_SUBSTEPS});
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.report.strategy == HM_STRATEGY_UNTANGLED);
        CHECK(safe.report.step_fraction == 1);
        CHECK(safe.report.resolves == 0);
        CHECK(safe.report.untangled > 0);
        CHECK(safe.report.iterations > 0);
        CHECK(safe.is_valid());
        CHECK(safe.boundary_error(move) < 1e-15);
        // Substeps first, as far as they are allowed, then the rest.
        safe.safe_options.skipped_strategies = 0;
        safe.safe_options.max_resolves = -1;
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.report.resolves == 0);
        CHECK(safe.report.step_fraction == 1);
        CHECK(safe.is_valid());
        CHECK(safe.report.strategy == HM_STRATEGY_UNTANGLED);
        CHECK(safe.report.steps == 2);
        CHECK(safe.boundary_error(move) < 1e-15);
    }
}

TEST_CASE("the wall has the same bits for every strategy, without accumulated rounding") {
    Case setup = block_in_square(Cells::quads, 15);
    Safe safe(setup);
    std::vector<double> const move = turn_of(setup, 115, {0.0123, 0.0321});
    std::vector<double> wall;
    for (std::int32_t const skipped :
         {without({HM_STRATEGY_UNTANGLED}), without({HM_STRATEGY_SUBSTEPS})}) {
        safe.safe_options.skipped_strategies = skipped;
        REQUIRE(safe.run(move) == HM_OK);
        std::vector<double> found;
        for (std::int32_t const point : points_on(setup.mesh, body))
            found.insert(found.end(), {safe.x[std::size_t(point)], safe.y[std::size_t(point)]});
        if (!wall.empty()) CHECK(same_bits(found, wall));
        wall = found;
    }
}
