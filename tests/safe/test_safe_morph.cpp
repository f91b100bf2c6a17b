// Safe morphs: no cell is inverted and no boundary crosses whatever happens, and the report is
// true.
#include <fixtures/safe.hpp>
#include <fixtures/bounded.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/fitted.hpp>

using namespace fixtures;

TEST_CASE("slip points stay on lines and periodic sides move alike, also in untangling") {
    Case slip = block_in_square(Cells::hybrid, 15), pair = block_in_square(Cells::hybrid, 15);
    for (std::int32_t const side : {bottom, right, top, left}) slip.set_slip(side);
    pair.set_periodic(left, right);
    for (std::int32_t const skipped :
         {without({HM_STRATEGY_UNTANGLED}), without({HM_STRATEGY_SUBSTEPS})}) {
        Safe slipping(slip), alike(pair);
        slipping.safe_options.skipped_strategies = alike.safe_options.skipped_strategies = skipped;
        REQUIRE(slipping.run(turn_of(slip, 120, {0.1, 0.02})) == HM_OK);
        REQUIRE(slipping.report.strategy != HM_STRATEGY_LINEAR);
        double slip_place = 0;
        for (std::int32_t const point : points_on(slip.mesh, bottom)) {
            CHECK(slipping.y[std::size_t(point)] == 0);
            slip_place =
                std::fmax(slip_place, std::fabs(slipping.moved()[std::size_t(point)].real()));
        }
        CHECK(slip_place > 1e-3);
        REQUIRE(alike.run(turn_of(pair, 110, {0.1, 0.05})) == HM_OK);
        REQUIRE(alike.report.strategy != HM_STRATEGY_LINEAR);
        std::vector<std::int32_t> const l = points_on(pair.mesh, left),
                                        r = points_on(pair.mesh, right);
        Field const moved = alike.moved();
        for (std::size_t j = 0; j < l.size(); ++j)
            CHECK(std::abs(moved[std::size_t(l[j])] - moved[std::size_t(r[j])]) < 1e-15);
    }
}

TEST_CASE("slipping points that would pass each other in one step do not in several steps") {
    Case setup;
    setup.mesh = square(25, Cells::quads, 5, 1);
    setup.curves = polyline({{0.4, 0.48}, {0.6, 0.48}, {0.6, 0.52}, {0.4, 0.52}});
    setup.put_on_curves(body);
    for (std::int32_t const side : {bottom, right, top, left}) setup.set_slip(side);
    Safe safe(setup);  // conformal, 1 / d^1.5
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(turn_of(setup, 60, {-0.2, -0.3})) == HM_OK);
    CHECK(safe.report.step_fraction == 1);
    CHECK(safe.report.strategy == HM_STRATEGY_SUBSTEPS);
    CHECK(safe.is_valid());
}

TEST_CASE("heights of the first layer are limited where asked for, or a warning names the place") {
    Case setup;
    setup.mesh = o_mesh(naca4({}, 40), stretched(1e-3, 8, 24));
    setup.curves.add(fitted_loop(points_along(setup.mesh, body), 16));
    setup.put_on_curves(body);
    Safe safe(setup);
    std::vector<double> move(setup.curves.control.size());
    for (std::size_t k = 0; k < move.size(); k += 2) {
        double const x = setup.curves.control[k];
        move[k + 1] = 0.4 * x * (1 - x);  // a camber of .1
    }
    REQUIRE(safe.run(move) == HM_OK);
    double const low = safe.report.min_height_ratio, high = safe.report.max_height_ratio;
    double const change = std::max(high, 1 / low);
    CHECK(safe.report.heights == 0);
    REQUIRE(change > 1.1);  // conformal functions stretch heights with the wall
    // hm_quality_bounds finds the same heights and angles at the same points.
    std::vector<double> const x = safe.x, y = safe.y;
    Bounded const bounded(setup);
    auto const layer = bounds_of(bounded, positions(safe.moved_mesh()),
                                 {HM_BOUND_HEIGHT, HM_BOUND_STRETCH, HM_BOUND_ANGLE});
    CHECK(layer[0].value.extreme == doctest::Approx(low).epsilon(1e-12));
    CHECK(layer[0].value.item == safe.report.min_height_point);
    CHECK(layer[1].value.extreme == doctest::Approx(high).epsilon(1e-12));
    CHECK(layer[1].value.item == safe.report.max_height_point);
    CHECK(std::acos(layer[2].value.extreme) * 180 / pi ==
          doctest::Approx(safe.report.max_angle_change).epsilon(1e-9));
    CHECK(layer[2].value.item == safe.report.angle_point);
    // A limit that is kept anyway changes nothing.
    safe.safe_options.max_height_change = 1.01 * change;
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(same_bits(safe.x, x));
    CHECK(same_bits(safe.y, y));
    // With a limit of half of the change, heights are restored.
    safe.safe_options.max_height_change = 1 + 0.5 * (change - 1);
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.is_valid());
    CHECK(safe.report.max_height_ratio <= safe.safe_options.max_height_change);
    CHECK(safe.report.min_height_ratio >= 1 / safe.safe_options.max_height_change);
    // Heights are restored but for rounding; a smaller limit cannot be kept, and a warning says so.
    safe.safe_options.max_height_change = 1 + 1e-9;
    CHECK(safe.run(move) == HM_OK);
    safe.safe_options.max_height_change = std::nextafter(1.0, 2.0);
    CHECK(safe.run(move) == HM_POOR);
    CHECK(safe.is_valid());
    CHECK(says(safe.error, "the height of the first layer at point"));
    CHECK(safe.report.max_height_ratio < high);
    std::vector<std::int32_t> const wall = points_on(setup.mesh, body);
    CHECK(std::find(wall.begin(), wall.end(), safe.error.item) != wall.end());
}

TEST_CASE("a mesh short of the target is the last valid one, at the reported fraction of the way") {
    Case setup = block_in_square();
    Safe safe(setup);
    std::vector<double> const move = turn_of(setup, 150);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
    safe.safe_options.max_resolves = 1;
    std::vector<double> reached(move.size(), -1);
    safe.safe_options.reached = reached.data();
    REQUIRE(safe.run(move) == HM_SHORT);
    double const t = safe.report.step_fraction;
    CHECK(t > 0.05);
    CHECK(t < 1);
    CHECK(safe.report.steps == 2);
    CHECK(safe.report.resolves == 1);
    CHECK(safe.error.value == t);
    CHECK(safe.report.cell >= 0);
    CHECK(safe.report.cell < setup.mesh.n_cells());
    CHECK(safe.error.item == safe.report.cell);
    CHECK(says(safe.error, "cell " + std::to_string(safe.report.cell) + " at ("));
    CHECK(says(safe.error, "would invert"));
    CHECK(safe.is_valid());
    CHECK(safe.boundary_error(turn_of(setup, 150 * t)) < 1e-11);  // a turn is a turn all the way
    CHECK(safe.boundary_error(reached) < 1e-15);
    for (int const resolves : {-1, 2, 4}) {  // the more is allowed, the farther
        double const before = resolves < 0 ? 0 : t;
        safe.safe_options.max_resolves = resolves;
        hm_status const status = safe.run(move);
        CHECK((status == HM_SHORT || status == HM_OK));
        CHECK(safe.report.step_fraction > before);
        CHECK((resolves > 0 || safe.report.step_fraction < t));
        CHECK(safe.is_valid());
    }
}

TEST_CASE("a boundary that crosses itself is refused at once, and nothing is written") {
    Case setup = block_in_square();
    Safe safe(setup);
    std::vector<double> move(8, 0.0);
    move[0] = 0.3;  // the lower left corner behind the lower right one, and up
    move[1] = 0.06;
    Solved const derivative(setup, options_of(HM_CONFORMAL));
    CHECK(safe.run(move, derivative.basis) == HM_CROSSING);
    CHECK(safe.untouched());
    CHECK(safe.report.crossing_points[0] >= 0);
    CHECK(safe.report.crossing_points[2] >= 0);
    CHECK(safe.report.steps == 0);
    std::vector<std::int32_t> const on_body = points_on(setup.mesh, body);
    for (std::int32_t const point : safe.report.crossing_points)
        CHECK(std::find(on_body.begin(), on_body.end(), point) != on_body.end());
    CHECK(safe.error.item == safe.report.crossing_points[0]);
    CHECK(safe.run(turn_of(setup, 0, {0.45, 0.013})) ==
          HM_CROSSING);                         // through the side of the square
    CHECK(safe.report.mean_height_ratio == 1);  // nothing moved
    CHECK(safe.report.min_height_ratio == 1);
    CHECK(safe.report.max_height_ratio == 1);
    CHECK(safe.untouched());
    hm_basis_info const info = info_of(derivative.basis);
    CHECK(info.solved == 1);  // refused: as it was
}

TEST_CASE("a thousand random movements of growing size are valid or refused with a reason") {
    struct Start {
        Case setup;
        std::int32_t operator_kind;
    };
    Case tiny = tiny_case(), bodies = two_body_case(Cells::hybrid, 4, 3), channel = tiny_case();
    for (std::int32_t const side : {bottom, right, top, left}) channel.set_slip(side);
    bodies.conditions.pop_back();
    bodies.set_rigid(second_body, 1.5, 0.5);
    Case cascade = tiny_case();
    cascade.set_periodic(left, right);
    Start starts[] = {{tiny, HM_CONFORMAL},
                      {tiny, HM_LAPLACE},
                      {bodies, HM_CONFORMAL},
                      {channel, HM_CONFORMAL},
                      {cascade, HM_CONFORMAL}};
    for (Start& start : starts) {
        Safe safe(start.setup, options_of(start.operator_kind));
        std::int32_t const n = safe.solved().info().functions;
        double const size = start.setup.curves.n_control() == 4 ? 4 : 0.5;
        int reached = 0, refused = 0, by_strategy[4] = {};
        for (unsigned trial = 0; trial < 200; ++trial) {
            std::vector<double> const move = some_move(n, size * trial / 200.0, 100 + trial);
            hm_status const status = safe.run(move);
            INFO("trial " << trial << ": " << safe.error.text);
            REQUIRE((status == HM_OK || status == HM_SHORT || status == HM_CROSSING));
            if (status == HM_CROSSING) {
                CHECK(safe.untouched());
                ++refused;
                continue;
            }
            CHECK(safe.is_valid());
            if (status == HM_SHORT) {
                CHECK(safe.report.step_fraction < 1);
                CHECK(safe.error.text[0] != '\0');
                continue;
            }
            ++reached;
            ++by_strategy[safe.report.strategy];
            CHECK(safe.report.step_fraction == 1);
            CHECK(std::fabs(safe.boundary_error(move) - safe.report.rotated_offset) < 1e-14);
        }
        CHECK(reached > 10);
        CHECK(refused > 5);
        CHECK(by_strategy[HM_STRATEGY_LINEAR] > 0);
        CHECK(by_strategy[HM_STRATEGY_SUBSTEPS] > 0);
        CHECK(by_strategy[HM_STRATEGY_UNTANGLED] > 0);
    }
}

TEST_CASE("the two sides of the wake stay one when an airfoil in a C-mesh moves at random") {
    CMesh const c = c_mesh(naca4({}, 24), 12, 8, stretched(5e-3, 8, 12));
    Case setup = airfoil_case(24, 12);
    setup.mesh = c.mesh;
    Safe safe(setup);
    int by_strategy[4] = {};
    for (unsigned trial = 0; trial < 60; ++trial) {
        std::vector<double> move = similarity_move(setup.curves, std::polar(1.0, 0.05 * trial),
                                                   {0.25, 0}, {0.01 * trial, 0});
        std::vector<double> const more = some_move(12, 0.0005 * trial, 200 + trial);
        for (std::size_t k = 0; k < move.size(); ++k) move[k] += more[k];
        hm_status const status = safe.run(move);
        REQUIRE((status == HM_OK || status == HM_SHORT || status == HM_CROSSING));
        if (status == HM_CROSSING) continue;
        CHECK(safe.is_valid());
        if (status == HM_OK)
            CHECK(std::fabs(safe.boundary_error(move) - safe.report.rotated_offset) < 1e-14);
        ++by_strategy[safe.report.strategy];
        Mesh const& mesh = safe.mesh;
        std::map<std::pair<double, double>, std::size_t>
            first;  // points at one place stay at one place
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {
            std::size_t const first_point = first.insert({{mesh.x[k], mesh.y[k]}, k}).first->second;
            CHECK(safe.x[k] == safe.x[first_point]);
            CHECK(safe.y[k] == safe.y[first_point]);
        }
    }
    CHECK(by_strategy[HM_STRATEGY_LINEAR] > 10);
    CHECK(by_strategy[HM_STRATEGY_SUBSTEPS] + by_strategy[HM_STRATEGY_UNTANGLED] > 3);
}

TEST_CASE("numbering from 1, cells of either sense, and units change nothing but numbers") {
    Case setup = block_in_square(Cells::hybrid, 15);
    std::vector<double> const move = turn_of(setup, 150);
    Safe reference(setup);
    for (std::int32_t const skipped : {without({HM_STRATEGY_UNTANGLED}), 0}) {
        reference.safe_options.skipped_strategies = skipped;
        reference.safe_options.max_resolves = 2;
        hm_status const expected = reference.run(move);
        CHECK(expected == (skipped != 0 ? HM_SHORT : HM_OK));
        Case from_one = setup;
        from_one.index_base = 1;
        reverse_some(from_one.mesh, 3);
        Safe other(from_one);
        other.safe_options = reference.safe_options;
        CHECK(other.run(move) == expected);
        CHECK(other.report.strategy == reference.report.strategy);
        CHECK(other.report.step_fraction ==
              doctest::Approx(reference.report.step_fraction).epsilon(1e-9));
        // Steps of Newton's method amplify roundings at places that no quality depends on.
        CHECK(largest_difference(other.moved(), reference.moved()) < 1e-6);
        CHECK(other.report.min_quality ==
              doctest::Approx(reference.report.min_quality).epsilon(1e-6));
        CHECK(other.report.mean_quality ==
              doctest::Approx(reference.report.mean_quality).epsilon(1e-6));
        if (expected == HM_SHORT) {
            CHECK(other.report.cell == reference.report.cell + 1);
            CHECK(other.report.point == reference.report.point + 1);
            CHECK(other.error.item == other.report.cell);
        }
        CHECK(other.report.min_quality_cell == reference.report.min_quality_cell + 1);
        for (double const unit : {1e-9, 1e20}) {
            Case scaled = similar(setup, unit, 0);
            std::vector<double> scaled_move = move;
            for (double& m : scaled_move) m *= unit;
            Safe far(scaled);
            far.safe_options = reference.safe_options;
            CHECK(far.run(scaled_move) == expected);
            CHECK(far.report.strategy == reference.report.strategy);
            CHECK(far.report.steps == reference.report.steps);
            CHECK(far.report.step_fraction ==
                  doctest::Approx(reference.report.step_fraction).epsilon(1e-6));
            CHECK(far.is_valid());
            CHECK(far.report.min_quality ==
                  doctest::Approx(reference.report.min_quality).epsilon(1e-3));
        }
    }
}

TEST_CASE("functions on the way that miss the tolerance give a warning and a valid mesh") {
    Case setup = block_in_square(Cells::quads, 15);
    Options options = options_of(HM_CONFORMAL);
    options.tolerance = 1e-18;
    Attempt const attempt(setup.problem(), &options);
    REQUIRE(attempt.status == HM_NOT_CONVERGED);
    Guarded work = block_of(safe_move_size, attempt.plan, attempt.basis);
    auto report = sized<hm_safe_report>();
    std::vector<double> x(setup.mesh.x.size()), y(x.size());
    hm_error error{};
    CHECK(safe_move(attempt.plan, attempt.basis, turn_of(setup, 120).data(), points_out(x, y),
                    nullptr, work.data(), work.size(), nullptr, &report,
                    &error) == HM_NOT_CONVERGED);
    CHECK(report.step_fraction == 1);
    CHECK(report.resolves > 0);
    CHECK(report.inverted == 0);
    CHECK(x[0] == setup.mesh.x[0]);
    CHECK(error.value > 1e-18);
    // One step needs no functions other than the present ones.
    CHECK(safe_move(attempt.plan, attempt.basis, turn_of(setup, 10).data(), points_out(x, y),
                    nullptr, work.data(), work.size(), nullptr, &report, &error) == HM_OK);
}
