// Given displacements that a safe morph refuses: each by name, with the place, and without a change
// of the output.
#include <fixtures/memory.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;

TEST_CASE("refused displacements and arguments are named, and nothing is written") {
    Case setup = given_block();
    SafeDisplaced safe(setup);
    Field const good(safe.points.size(), Complex(0.01, 0));
    auto const refusal = [&](Field const& wall, hm_status expected, std::string const& word,
                             std::int32_t item) {
        CHECK(safe.run(wall) == expected);
        CHECK_MESSAGE(says(safe.error, word), safe.error.text);
        CHECK(fixtures::found(safe.error) == item);
        CHECK(safe.untouched());
    };
    Field crossing = good;
    crossing[0] += Complex(0.3, 0.2);
    CHECK(safe.run(crossing) == HM_CROSSING);
    CHECK(safe.untouched());
    CHECK(safe.safe_report.crossing_points[0] >= 0);
    Field bad = good;
    Untrapped const untrapped;  // comparisons with a number that is none
    bad[2] = {0, std::nan("")};
    refusal(bad, HM_BAD_ARGUMENT, "is not finite", safe.points[2]);
    bad[2] = 1e101;
    refusal(bad, HM_BAD_ARGUMENT, "exceeds 1e100 in magnitude", safe.points[2]);
    refusal(Field(good.begin(), good.end() - 1), HM_BAD_ARGUMENT, "points have given displacements",
            std::int32_t(good.size()) - 1);
    CHECK(safe.run(Field(good.size(), Complex(5, 0))) == HM_CROSSING);
    CHECK(says(safe.error, "outside"));
    CHECK(safe.untouched());
    safe.safe_options.n_others = 1;
    refusal(good, HM_BAD_ARGUMENT, "others", 1);
    safe.safe_options.n_others = 0;

    Case with_curve = two_body_case(Cells::hybrid, 8, 6);
    Attempt const curves(with_curve.problem());
    std::size_t bytes = 0;
    hm_error error{};
    CHECK(safe_displace_size(curves.plan, curves.basis, &bytes, &error) == HM_BAD_CONDITION);
    with_curve.conditions.pop_back();
    with_curve.set_given(second_body);
    Attempt unsolved = prepared(with_curve.problem());
    CHECK(safe_displace_size(unsolved.plan, unsolved.basis, &bytes, &error) == HM_BAD_BASIS);
    CHECK(safe_displace_size(unsolved.plan, safe.basis, &bytes, &error) == HM_BAD_BASIS);
    Guarded work = block_of(safe_displace_size, safe.plan, safe.basis);
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    hm_points const wall = pairs_in(good);
    auto const n = std::int32_t(good.size());
    std::vector<std::int32_t> twice = safe.points;
    twice[1] = twice[0];
    CHECK(safe_displace(safe.plan, safe.basis, nullptr, n, twice.data(), &wall, points_out(x, y),
                        work.data(), work.size(), nullptr, nullptr, &error) == HM_BAD_CONDITION);
    CHECK(same_bits(x, setup.mesh.x));
    CHECK(same_bits(y, setup.mesh.y));
}
