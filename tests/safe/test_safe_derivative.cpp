// The derivative of a safe morph: a basis that takes small movements from where the mesh is now.
#include <fixtures/safe.hpp>

using namespace fixtures;

TEST_CASE("the derivative is exact at the wall, the sum of the steps elsewhere") {
    for (bool const slip : {false, true})
        for (bool const untangled : {false, true}) {
            Case setup = block_in_square(Cells::quads, 15);
            if (slip)
                for (std::int32_t const side : {bottom, right, top, left}) setup.set_slip(side);
            Options const options = options_of(HM_CONFORMAL);
            Safe safe(setup, options);
            Attempt real = prepared(setup.problem(), options);
            std::vector<double> const move = turn_of(setup, 120, {slip ? 0.1 : 0.05, 0.02});
            if (untangled) safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS});
            REQUIRE(safe.run(move, real.basis) == HM_OK);
            CHECK(real.guards_intact());
            CHECK(safe.report.strategy ==
                  (untangled ? HM_STRATEGY_UNTANGLED : HM_STRATEGY_SUBSTEPS));
            std::vector<double> const further = some_move(4, 1, 3);
            Field const by = displacement(real.basis, further),
                        of_wall = displacement(safe.solved(), further);
            for (std::int32_t const point : points_on(setup.mesh, body))
                CHECK(std::abs(by[std::size_t(point)] - of_wall[std::size_t(point)]) < 1e-13);
            for (std::int32_t const point : points_on(setup.mesh, bottom)) {
                Complex const d = by[std::size_t(point)];
                CHECK((slip ? d.imag() == 0 : d == 0.0));
            }
            check_adjoint(real.basis, further, 1e-13);
            // The derivative is a basis like any other: complete, solved, and of this mesh.
            hm_mesh const mesh = setup.mesh.view();
            hm_basis_info const info = info_of(real.basis);
            const hm_basis* attached = nullptr;
            CHECK(hm_basis_attach(&attached, real.basis, std::size_t(info.bytes), &mesh, nullptr) ==
                  HM_OK);
        }
}

TEST_CASE("where untangling ends in a poor mesh, the derivative is that of the whole path") {
    Case setup = block_in_square(Cells::quads, 15);
    Options const options = options_of(HM_CONFORMAL);
    Safe safe(setup, options);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS, HM_STRATEGY_IMPROVED});
    safe.safe_options.min_quality = 0.99;  // no mesh is as good as that
    Attempt derivative = prepared(setup.problem(), options);
    REQUIRE(safe.run(turn_of(setup, 120), derivative.basis) == HM_POOR);
    REQUIRE(safe.report.strategy == HM_STRATEGY_UNTANGLED);
    std::vector<double> const further = some_move(4, 1, 3);
    Field const by = displacement(derivative.basis, further),
                of_wall = displacement(safe.solved(), further);
    for (std::int32_t const point : points_on(setup.mesh, body))
        CHECK(std::abs(by[std::size_t(point)] - of_wall[std::size_t(point)]) < 1e-13);
}

TEST_CASE("the derivative is the basis after one step; the mean of the steps on straight paths") {
    Case setup = block_in_square(Cells::quads, 15);
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Options const options = options_of(operator_kind);
        Safe safe(setup, options);
        Attempt derivative = prepared(setup.problem(), options);
        REQUIRE(safe.run(turn_of(setup, 1), derivative.basis) == HM_OK);
        REQUIRE(safe.report.strategy == HM_STRATEGY_LINEAR);
        std::vector<double> const further = some_move(4, 1, 5);
        CHECK(largest_difference(displacement(derivative.basis, further),
                                 displacement(safe.solved(), further)) < 1e-15);
    }
    // Straight ways and frozen functions: x_new = x + sum over the steps of (t_k - t_(k-1)) F_k dP
    // is linear in dP, so that the derivative by dP, applied to dP itself, is all that the mesh has
    // moved.
    Safe safe(setup, options_of(HM_LAPLACE));
    Options const options = options_of(HM_LAPLACE);
    Attempt derivative = prepared(setup.problem(), options);
    std::vector<double> const move = turn_of(setup, 35, {0.1, 0.05});
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(move, derivative.basis) >= 0);
    REQUIRE(safe.report.steps > 2);
    if (safe.status == HM_OK)
        CHECK(largest_difference(displacement(derivative.basis, move), safe.moved()) < 1e-12);
}

TEST_CASE("the derivative is the sum of the steps' functions times the change of each step") {
    Case setup = block_in_square(Cells::quads, 15);
    Options const options = options_of(HM_CONFORMAL);
    Safe safe(setup, options);
    Attempt derivative = prepared(setup.problem(), options);
    double const degrees = 120;
    std::vector<double> const move = turn_of(setup, degrees), further = some_move(4, 1, 6);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(move, derivative.basis) == HM_OK);
    std::int32_t const steps = safe.report.steps;
    REQUIRE(steps > 2);
    // The way of a turn by the angle a is P(t) = c + r^t (P + t D), r = e^(i a), D = (P + dP - c) /
    // r - P + c, and so dP(t) / d(dP) = t r^(t - 1) while r is held.
    auto const weight = [&](double t) { return t * std::polar(1.0, (t - 1) * degrees * pi / 180); };
    Field const found = displacement(derivative.basis, further);
    Field expected(found.size(), 0);
    double from = 0;
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    for (std::int32_t step = 1; step <= steps; ++step) {
        // The functions of this step, on the mesh at its start.
        Attempt const here = prepared(setup.problem(), options);
        REQUIRE(hm_plan_factor(here.plan, points_in(x, y), nullptr) == HM_OK);
        REQUIRE(hm_plan_solve(here.plan, here.basis, nullptr, nullptr) == HM_OK);
        safe.safe_options.max_resolves = step == 1 ? -1 : step - 1;  // the way as far as that
        // With a derivative as before: without one, other paths are tried, too.
        Attempt const unused = prepared(setup.problem(), options);
        REQUIRE(safe.run(move, unused.basis) == (step < steps ? HM_SHORT : HM_OK));
        REQUIRE(safe.report.steps == step);
        double const to = safe.report.step_fraction;
        Field const part = displacement(here.basis, turned(further, weight(to) - weight(from)));
        for (std::size_t k = 0; k < part.size(); ++k) expected[k] += part[k];
        from = to;
        x = safe.x;
        y = safe.y;
    }
    CHECK(from == 1);
    CHECK(largest_difference(found, expected) < 1e-10);
}

TEST_CASE("differences of two safe morphs agree with the derivative where they should") {
    // Points of the square are on their polygon, so that no offset turns.
    for (bool const several : {false, true}) {
        Case setup = block_in_square(Cells::quads, 15);
        Options const options = options_of(HM_CONFORMAL);
        Safe safe(setup, options);
        Attempt attempt = prepared(setup.problem(), options);
        std::vector<double> const move = turn_of(setup, several ? 100 : 10, {0.03, 0.02}),
                                  along = some_move(4, 1, 7);
        safe.safe_options.skipped_strategies =
            several ? without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED})
                    : without({HM_STRATEGY_SUBSTEPS});
        REQUIRE(safe.run(move, attempt.basis) == HM_OK);
        CHECK((safe.report.steps > 1) == several);
        Field const derivative = displacement(attempt.basis, along);
        double const h = 1e-5;
        auto const moved_by = [&](double step) {
            std::vector<double> further = move;
            for (std::size_t k = 0; k < further.size(); ++k) further[k] += step * along[k];
            REQUIRE(safe.run(further) == HM_OK);
            return safe.moved();
        };
        Field const ahead = moved_by(h), back = moved_by(-h);
        std::vector<std::int32_t> const wall = points_on(setup.mesh, body);
        double worst = 0;
        for (std::size_t k = 0; k < ahead.size(); ++k)
            if (!several || std::binary_search(wall.begin(), wall.end(), std::int32_t(k)))
                worst = std::max(worst, std::abs((ahead[k] - back[k]) / (2 * h) - derivative[k]));
        INFO("several steps: " << several);
        CHECK(worst < 1e-9);
    }
}
