// Given displacements end with good cells, not just with valid ones.
#include <fixtures/safe.hpp>
#include <fixtures/channels.hpp>

using namespace fixtures;

namespace {

// Returns displacements by which the wall of a nozzle with a slipping axis comes to `part` of its
// height.
Field squeezed(SafeDisplaced const& safe, double part) {
    Field out;
    for (Complex const z : safe.start()) out.push_back({0, (part - 1) * z.imag()});
    return out;
}

// Returns the quality after one step of a displacement by Laplace functions.
double laplace_quality(Case& setup, double part) {
    SafeDisplaced one(setup, options_of(HM_LAPLACE));
    one.safe_options.skipped_strategies = 0xff & ~(1 << HM_STRATEGY_LINEAR);
    one.safe_options.skipped_strategies &= (2 << HM_STRATEGY_IMPROVED) - 1;
    REQUIRE(one.run(squeezed(one, part)) >= HM_OK);
    return one.safe_report.step_fraction < 1 ? 0 : one.safe_report.min_quality;
}

}  // namespace

TEST_CASE("in a nozzle that its wall narrows, other functions are tried where one step is poor") {
    int poor = 0;
    for (double const part : {0.8, 0.6, 0.4}) {
        Case setup = given_instead(nozzle(24, 12, 0.01, 8));
        setup.set_slip(right);
        setup.set_slip(left);
        SafeDisplaced safe(setup);
        safe.safe_options.min_quality = 0;  // the default
        Field const wall = squeezed(safe, part);
        double const laplace = laplace_quality(setup, part);
        REQUIRE(safe.run(wall) == HM_OK);
        INFO("to " << part << ": " << safe.safe_report.min_quality << ", laplace " << laplace);
        CHECK(safe.is_at(wall));
        double const fair = 0.3 * safe.safe_report.start_quality;
        CHECK(safe.safe_report.min_quality >= std::fmin(fair, laplace));
        safe.safe_options.skipped_strategies = 1 << HM_STRATEGY_OTHER | 1 << HM_STRATEGY_IMPROVED;
        REQUIRE(safe.run(wall) >= HM_OK);
        poor += safe.safe_report.min_quality < std::fmin(fair, laplace);
    }
    CHECK(poor > 0);  // else the test has not seen what it is about
}

TEST_CASE("the option to improve gives better cells in the same call, with heights or without") {
    Case setup = given_block();
    SafeDisplaced safe(setup);
    Field const wall = safe.similarity(std::polar(1.0, 1.0), {0.5, 0.5});
    REQUIRE(safe.run(wall) >= HM_OK);
    double const before = safe.safe_report.min_quality, mean = safe.safe_report.mean_quality;
    safe.safe_options.improve = 1;
    REQUIRE(safe.run(wall) >= HM_OK);
    CHECK(safe.is_at(wall));
    CHECK(safe.safe_report.min_quality >= before);
    CHECK(safe.safe_report.mean_quality > mean);
    double const alone = safe.safe_report.min_quality;
    safe.safe_options.heights = 1;
    REQUIRE(safe.run(wall) >= HM_OK);
    CHECK(safe.is_at(wall));
    CHECK(safe.safe_report.min_quality >= alone * (1 - 1e-12));
}

TEST_CASE("a limit of height changes is kept after the improvement, or a warning is given") {
    int kept = 0, missed = 0;
    for (double const angle : {0.3, 0.6, 0.9, 1.2}) {
        Case setup = block_in_square();
        Safe safe(setup);
        safe.safe_options.improve = 1;
        safe.safe_options.max_height_change = 1.05;
        hm_status const status = safe.run(turn_of(setup, angle * 180 / pi));
        REQUIRE(status >= HM_OK);
        double const change =
            std::fmax(safe.report.max_height_ratio, 1 / safe.report.min_height_ratio);
        INFO("angle " << angle << ", change " << change);
        CHECK((change <= 1.05) == (status == HM_OK));
        kept += status == HM_OK;
        missed += status == HM_POOR;
    }
    CHECK(kept + missed == 4);
}
