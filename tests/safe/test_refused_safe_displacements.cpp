// Given displacements that a safe morph refuses: each by name, with the place, and without a change
// of the output.
#include <fixtures/found.hpp>
#include <fixtures/safe_displaced.hpp>
#include <fixtures/traps.hpp>

using namespace fixtures;

TEST_CASE("refused displacements and arguments are named, and nothing is written") {
    Case setup = given_block();
    SafeDisplaced safe(setup);
    Field const good(safe.points.size(), Complex(0.01, 0));
    auto const refusal = [&](Field const& wall, hm_status expected, std::string const& word,
                             std::int32_t item) {
        CHECK(safe.run(wall) == expected);
        CHECK_MESSAGE(std::string(safe.error.text).find(word) != std::string::npos,
                      safe.error.text);
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
    CHECK(std::string(safe.error.text).find("outside") != std::string::npos);
    CHECK(safe.untouched());
    safe.safe_options.n_others = 1;
    refusal(good, HM_BAD_ARGUMENT, "others", 1);
    safe.safe_options.n_others = 0;
    safe.safe_options.min_quality = 2;
    refusal(good, HM_BAD_ARGUMENT, "min_quality", 2);
    safe.safe_options.min_quality = 0;

    Case with_curve = two_body_case(Cells::hybrid, 8, 6);
    Attempt const curves(with_curve.problem());
    std::size_t bytes = 0;
    hm_error error{};
    CHECK(hm_displace_safe_size(curves.plan, curves.basis, &bytes, &error) == HM_BAD_CONDITION);
    with_curve.conditions.pop_back();
    with_curve.set_given(second_body);
    Attempt unsolved = prepared(with_curve.problem());
    CHECK(hm_displace_safe_size(unsolved.plan, unsolved.basis, &bytes, &error) == HM_BAD_BASIS);
    CHECK(hm_displace_safe_size(unsolved.plan, safe.basis, &bytes, &error) == HM_BAD_BASIS);
    CHECK(hm_displace_safe_size(nullptr, safe.basis, &bytes, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe_size(safe.plan, nullptr, &bytes, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe_size(safe.plan, safe.basis, nullptr, &error) == HM_BAD_ARGUMENT);
    REQUIRE(hm_displace_safe_size(safe.plan, safe.basis, &bytes, &error) == HM_OK);
    Guarded work(bytes);
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    const double* const values = reinterpret_cast<const double*>(good.data());
    hm_points const wall{values, values + 1, 2};
    auto const n = std::int32_t(good.size());
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, &wall, points_out(x, y),
                           work.data(), bytes - 1, nullptr, nullptr, &error) == HM_BLOCK_TOO_SMALL);
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, nullptr, points_out(x, y),
                           work.data(), bytes, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, &wall, nullptr, work.data(),
                           bytes, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, &wall, points_out(x, y),
                           nullptr, bytes, nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    std::vector<std::int32_t> twice = safe.points;
    twice[1] = twice[0];
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, twice.data(), &wall, points_out(x, y),
                           work.data(), bytes, nullptr, nullptr, &error) == HM_BAD_CONDITION);
    CHECK(same_bits(x, setup.mesh.x));
    CHECK(same_bits(y, setup.mesh.y));
}
