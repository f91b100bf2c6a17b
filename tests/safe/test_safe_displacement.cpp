// Given displacements by the strategies of a safe morph: the whole displacement with the given
// bits, or how far and why.
#include <fixtures/executors.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/hybrid.hpp>

using namespace fixtures;

TEST_CASE("a displacement that is possible in one step is that of hm_displace") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL}) {
        Case setup = given_block(Cells::hybrid);
        SafeDisplaced safe(setup, options_of(kind));
        Field wall = some_field(safe.points.size(), 3, 2e-3);
        for (Complex& w : wall) w += Complex(0.03, -0.01);
        Field const expected = safe.displace(wall);
        REQUIRE(safe.run(wall) == HM_OK);
        CHECK(safe.safe_report.strategy == HM_STRATEGY_LINEAR);
        CHECK(safe.safe_report.resolves == 0);
        CHECK(safe.safe_report.step_fraction == 1);
        CHECK(safe.is_at(wall));
        for (std::size_t k = 0; k < expected.size(); ++k) {
            CHECK(std::fabs(safe.x[k] - setup.mesh.x[k] - expected[k].real()) < 1e-14);
            CHECK(std::fabs(safe.y[k] - setup.mesh.y[k] - expected[k].imag()) < 1e-14);
        }
        REQUIRE(safe.run(Field(wall.size())) == HM_OK);
        CHECK(safe.untouched());
    }
}

TEST_CASE("a rotation of 150 degrees with a change of shape has the given bits for all operators") {
    for (int const variant : {0, 1, 2, 3}) {
        Case setup = given_block(variant == 1 ? Cells::triangles : Cells::quads);
        Options options = options_of(variant == 1   ? HM_LAPLACE
                                     : variant == 2 ? HM_WEIGHTED
                                                    : HM_CONFORMAL);
        if (variant == 3) options = options_of(HM_LAPLACE), options.engine = HM_MULTIGRID;
        SafeDisplaced safe(setup, options);
        Field wall = safe.similarity(std::polar(1.1, 150 * pi / 180), {0.5, 0.5}, {0.02, 0.05});
        Field const start = safe.start();
        for (std::size_t k = 0; k < wall.size(); ++k)
            wall[k] += 0.01 * std::sin(20 * start[k].real());
        INFO("variant " << variant);
        CHECK(safe.run(wall) == HM_OK);
        INFO(safe.error.text);
        CHECK(safe.safe_report.strategy >= HM_STRATEGY_SUBSTEPS);
        CHECK(safe.safe_report.step_fraction == 1);
        CHECK(safe.safe_report.resolves > 0);
        CHECK(safe.is_at(wall));
        CHECK(safe.safe_report.n_worst == 5);
        CHECK(safe.safe_report.worst[0].quality == safe.safe_report.min_quality);
    }
}

TEST_CASE("a body that turns in steps keeps its shape, and fewer cells suffer") {
    Case setup = given_block();
    SafeDisplaced safe(setup);
    Field const half = safe.similarity(std::polar(1.0, 178 * pi / 180), {0.5, 0.5});
    safe.safe_options.skipped_strategies =
        without({HM_STRATEGY_UNTANGLED, HM_STRATEGY_OTHER, HM_STRATEGY_IMPROVED});
    safe.safe_options.max_resolves = 30;
    REQUIRE(safe.run(half) == HM_OK);  // straight lines would pass through a body of no size
    CHECK(safe.safe_report.strategy == HM_STRATEGY_SUBSTEPS);
    CHECK(safe.is_at(half));
}

TEST_CASE("functions of another operator are solved where one step of the first is not enough") {
    Case setup = given_block();
    SafeDisplaced safe(setup, options_of(HM_CONFORMAL, 4));
    safe.safe_options.skipped_strategies =
        without({HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
    bool helped = false;
    for (double shift = 0.05; shift < 0.5 && !helped; shift += 0.01) {
        Field const wall(safe.points.size(), Complex(shift, 0));
        if (safe.run(wall) != HM_OK || safe.safe_report.strategy != HM_STRATEGY_OTHER) continue;
        CHECK(safe.safe_report.resolves > 0);
        CHECK((safe.safe_report.other == HM_CONFORMAL || safe.safe_report.other == HM_LAPLACE));
        CHECK(safe.is_at(wall));
        std::int32_t const skipped = safe.safe_options.skipped_strategies;
        safe.safe_options.skipped_strategies |= without({HM_STRATEGY_OTHER});
        helped = safe.run(wall) == HM_SHORT;  // else the one step was valid, but poor
        safe.safe_options.skipped_strategies = skipped;
        if (!helped) continue;
        CHECK(safe.safe_report.step_fraction < 1);
        CHECK(safe.safe_report.step_fraction > 0);
    }
    CHECK(helped);
}

TEST_CASE("threads and the order of the list do not change a bit") {
    Case setup = given_block();
    SafeDisplaced one(setup);
    Field const wall = one.similarity(std::polar(1.0, 100 * pi / 180), {0.5, 0.5});
    REQUIRE(one.run(wall) == HM_OK);
    Backwards backwards;
    hm_executor const executor = backwards.executor(3);
    Options options = options_of(HM_CONFORMAL);
    options.executor = &executor;
    SafeDisplaced three(setup, options);
    REQUIRE(three.run(wall) == HM_OK);
    CHECK(same_bits(one.x, three.x));
    CHECK(same_bits(one.y, three.y));
    // reversed list, with its first point twice
    std::vector<std::int32_t> list(one.points.rbegin(), one.points.rend());
    Field reversed(wall.rbegin(), wall.rend());
    list.push_back(list[0]);
    reversed.push_back(reversed[0]);
    Guarded work = block_of(safe_displace_size, one.plan, one.basis);
    hm_points const given = pairs_in(reversed);
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    REQUIRE(safe_displace(one.plan, one.basis, nullptr, std::int32_t(list.size()), list.data(),
                          &given, points_out(x, y), work.data(), work.size(), &one.safe_options,
                          nullptr, nullptr) == HM_OK);
    CHECK(same_bits(one.x, x));
    CHECK(same_bits(one.y, y));
}

TEST_CASE("a displacement that is partly possible reports the fraction and the limiting cell") {
    Case setup = given_block();
    SafeDisplaced safe(setup);
    Field const wall(safe.points.size(), Complex(0.35, 0));  // into the corner cells of the side
    safe.safe_options.max_resolves = -1;
    safe.safe_options.skipped_strategies =
        without({HM_STRATEGY_OTHER, HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(wall) == HM_SHORT);
    double const part = safe.safe_report.step_fraction;
    CHECK(part > 0);
    CHECK(part < 1);
    CHECK(safe.error.value == doctest::Approx(part));
    CHECK(safe.safe_report.cell >= 0);
    for (std::size_t k = 0; k < safe.points.size(); ++k) {
        auto const at = std::size_t(safe.points[k]);
        CHECK(safe.x[at] - safe.mesh.x[at] ==
              doctest::Approx(part * wall[k].real()).epsilon(1e-12));
    }
    safe.safe_options = {};
    safe.safe_options.struct_size = sizeof safe.safe_options;
    safe.safe_options.min_quality = 0.999;
    Field const little(safe.points.size(), Complex(0.05, 0));
    CHECK(safe.run(little) == HM_POOR);
    CHECK(safe.is_at(little));
    CHECK(safe.error.item == safe.safe_report.worst[0].cell);
}

TEST_CASE("given displacements limit heights of the first layer where asked for") {
    Case setup;
    setup.mesh = o_mesh(naca4({}, 40), stretched(1e-3, 8, 24));
    setup.set_given(body);
    SafeDisplaced safe(setup);
    Field wall;
    for (Complex const z : safe.start())
        wall.push_back({0, 0.4 * z.real() * (1 - z.real())});  // a camber of .1
    REQUIRE(safe.run(wall) == HM_OK);
    double const change =
        std::max(safe.safe_report.max_height_ratio, 1 / safe.safe_report.min_height_ratio);
    REQUIRE(change > 1.1);
    safe.safe_options.max_height_change = 1 + 0.5 * (change - 1);
    REQUIRE(safe.run(wall) == HM_OK);
    CHECK(safe.is_at(wall));
    CHECK(safe.safe_report.max_height_ratio <= safe.safe_options.max_height_change);
    CHECK(safe.safe_report.min_height_ratio >= 1 / safe.safe_options.max_height_change);
    safe.safe_options.max_height_change = std::nextafter(1.0, 2.0);
    CHECK(safe.run(wall) == HM_POOR);
    CHECK(safe.is_at(wall));
    CHECK(says(safe.error, "the height of the first layer at point"));
    CHECK(std::find(safe.points.begin(), safe.points.end(), safe.error.item) != safe.points.end());
}
