#include <harmorph_design.h>

#include <fixtures/memory.hpp>
#include <fixtures/single.hpp>

using namespace fixtures;

namespace {

double difference(Moved const& a, Moved const& b) {
    double worst = 0;
    for (std::size_t k = 0; k < a.x.size(); ++k)
        worst = std::max({worst, std::fabs(a.x[k] - b.x[k]), std::fabs(a.y[k] - b.y[k])});
    return worst;
}

Numbers moved_control_points(const hm_basis* basis, Numbers const& move) {
    Numbers out(std::size_t(2 * info_of(basis).control_points));
    hm_curve curve[2]{};
    auto curves = sized<hm_curves>();
    REQUIRE(hm_basis_curves(basis, move.data(), out.data(), &curves, curve, 2, nullptr) == HM_OK);
    return out;
}

std::vector<KindOfProblem> problems() {
    std::vector<KindOfProblem> out = kinds_of_problems();
    out.emplace_back();
    out.back().setup = cut_ring();
    out.back().options.operator_kind = HM_CONFORMAL;
    return out;
}

}  // namespace

TEST_CASE("combined functions move points, curves and gradients as their control points do") {
    for (KindOfProblem& problem : problems())
        for (int const numbers : {1, 2}) {
            Solved const solved(problem.setup, &problem.options);
            hm_basis_info const info = solved.info();
            Combination const by(info.control_points, 3, numbers, 5);
            Combined const combined(solved.basis, by);
            REQUIRE_MESSAGE(combined.status == HM_OK, combined.error.text);
            hm_basis_info const made = info_of(combined.basis);
            INFO("values of " << info.numbers_per_value << " numbers, matrix of " << numbers);
            CHECK(made.functions == 3 + 2 * info.bodies);
            CHECK(made.combined == 3);
            CHECK(made.control_points == info.control_points);
            CHECK(made.numbers_per_value == std::max(info.numbers_per_value, numbers));
            CHECK(made.bytes < info.bytes);

            Numbers const move = some_move(made.functions, 0.01, 7), whole = by.expanded(move);
            Moved const found = displaced(combined.basis, move),
                        expected = displaced(solved.basis, whole);
            CHECK(difference(found, expected) < 1e-14);
            CHECK(boundary_error(combined.basis, move, problem.setup.mesh,
                                 morphed(combined.basis, problem.setup.mesh, move)) < 1e-14);
            CHECK(largest_difference(moved_control_points(combined.basis, move),
                                     moved_control_points(solved.basis, whole)) < 1e-14);

            // g_j = sum_i conj(M_ij) G_i; and work done by both is the same.
            Gradient const g(problem.setup.mesh.x.size(), 3);
            Numbers const of_all = adjoint(solved.basis, g), of_few = adjoint(combined.basis, g);
            double size = 0, worst = 0, work = 0, done = 0, parts = 0;
            for (int j = 0; j < made.functions; ++j) {
                auto const at = std::size_t(2 * j);
                Complex sum = 0;
                for (int i = 0; j < 3 && i < info.control_points; ++i) {
                    auto const k = std::size_t(2 * i);
                    sum += std::conj(by.at(i, j)) * Complex(of_all[k], of_all[k + 1]);
                }
                auto const behind = std::size_t(2 * (info.control_points + j - 3));
                if (j >= 3) sum = {of_all[behind], of_all[behind + 1]};
                size = std::max(size, std::abs(sum));
                worst = std::max(worst, std::abs(sum - Complex(of_few[at], of_few[at + 1])));
                work += move[at] * of_few[at] + move[at + 1] * of_few[at + 1];
            }
            for (std::size_t k = 0; k < found.x.size(); ++k) {
                done += g.x[k] * found.x[k] + g.y[k] * found.y[k];
                parts += std::fabs(g.x[k] * found.x[k]) + std::fabs(g.y[k] * found.y[k]);
            }
            CHECK(worst <= 1e-13 * size);
            CHECK(std::fabs(work - done) <= 1e-14 * parts);
        }
}

TEST_CASE("combined functions can be extracted, written, attached, rounded and combined again") {
    for (KindOfProblem& problem : problems()) {
        Solved const solved(problem.setup, &problem.options);
        Combination const by(solved.info().control_points, 4, 2, 9), again(4, 2, 1, 10);
        Combined const combined(solved.basis, by);
        REQUIRE(combined.status == HM_OK);
        int const functions = info_of(combined.basis).functions;
        Numbers const move = some_move(functions, 0.01, 7);
        Moved const expected = displaced(combined.basis, move);

        std::vector<unsigned char> const bytes = bytes_of(combined.basis);
        Numbers block(bytes.size() / sizeof(double));
        std::memcpy(block.data(), bytes.data(), bytes.size());
        hm_mesh const mesh = problem.setup.mesh_view();
        const hm_basis* attached = nullptr;
        REQUIRE(hm_basis_attach(&attached, block.data(), bytes.size(), &mesh, nullptr) == HM_OK);
        CHECK(difference(displaced(attached, move), expected) == 0);

        Single const single(combined.basis);
        REQUIRE(single.status == HM_OK);
        CHECK(difference(displaced(single.basis, move), expected) < 1e-7);
        std::vector<std::int32_t> points;
        for (std::int32_t k = 0; k < mesh.n_points; k += 3) points.push_back(k);
        Rows const rows(combined.basis, points);
        REQUIRE(rows.status == HM_OK);
        Moved const part = displaced(rows.basis, move);
        for (std::size_t k = 0; k < points.size(); ++k)
            CHECK(part.x[k] == expected.x[std::size_t(points[k])]);
        Numbers const zero(points.size());
        CHECK(boundary_error(rows.basis, move, Moved{zero, zero}, part) < 1e-14);

        Combined const twice(combined.basis, again);
        REQUIRE_MESSAGE(twice.status == HM_OK, twice.error.text);
        Numbers const few = some_move(info_of(twice.basis).functions, 0.01, 8);
        Numbers const all = by.expanded(again.expanded(few));
        CHECK(difference(displaced(twice.basis, few), displaced(solved.basis, all)) < 1e-14);
        CHECK(largest_difference(moved_control_points(twice.basis, few),
                                 moved_control_points(solved.basis, all)) < 1e-14);
        CHECK(info_of(twice.basis).combined == 2);
    }
}

TEST_CASE("combined functions are solved again on a moved mesh as the control points are") {
    for (KindOfProblem& problem : problems())
        for (int const numbers : {1, 2}) {
            Solved const solved(problem.setup, &problem.options);
            Combination const by(solved.info().control_points, 3, numbers, 5);
            Combined const combined(solved.basis, by);
            REQUIRE(combined.status == HM_OK);
            Moved const at = morphed(solved.basis, problem.setup.mesh,
                                     some_move(solved.info().functions, 1e-3, 11));
            if (hm_plan_factor(solved.plan, points_in(at.x, at.y), nullptr) != HM_OK)
                continue;  // bounded scheme
            REQUIRE(hm_plan_solve(solved.plan, combined.basis, nullptr, nullptr) == HM_OK);
            REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
            Numbers const move = some_move(info_of(combined.basis).functions, 0.01, 7);
            CHECK(difference(displaced(combined.basis, move),
                             displaced(solved.basis, by.expanded(move))) < 1e-12);
        }
}

TEST_CASE("singular matrices, short blocks and numbers that are not finite are refused") {
    Case setup = ring_case(4, 24, 0.5, 1);
    Solved const solved(setup);
    Combination good(8, 3, 2, 4);
    auto const refusal = [&](Combination const& by, std::string const& word, int item) {
        Combined const combined(solved.basis, by);
        CHECK(combined.basis == nullptr);
        CHECK(fixtures::found(combined.error) == item);
        CHECK_MESSAGE(says(combined.error, word), combined.error.text);
        return combined.status;
    };
    Combination zero = good, twice = good, bad = good;
    for (int row = 0; row < 8; ++row) {
        for (int number = 0; number < 2; ++number)
            zero.entries[std::size_t((row * 3 + 1) * 2 + number)] = 0;
        Complex const turned = Complex(0.3, -2) * good.at(row, 0) + good.at(row, 1);
        twice.entries[std::size_t((row * 3 + 2) * 2)] = turned.real();
        twice.entries[std::size_t((row * 3 + 2) * 2 + 1)] = turned.imag();
    }
    bad.entries[7] = std::nan("");
    CHECK(refusal(zero, "the design variable moves no control point", 1) == HM_BAD_CONDITION);
    CHECK(refusal(twice, "is a linear combination of the columns before it", 2) ==
          HM_BAD_CONDITION);
    CHECK(refusal(bad, "not finite", 1) == HM_BAD_ARGUMENT);
    CHECK(refusal(Combination(8, 9, 1, 4), "9 variables cannot be independent", 9) ==
          HM_BAD_CONDITION);
    CHECK(refusal(Combination(8, 0, 1, 4), "n must be at least 1, not 0", -1) == HM_BAD_ARGUMENT);
    CHECK(Combined(solved.basis, good, 1).status == HM_BLOCK_TOO_SMALL);
    CHECK(Combined(solved.basis, good, 200).status == HM_BLOCK_TOO_SMALL);
    CHECK(Combined(Single(solved.basis).basis, good).status == HM_UNSUPPORTED);
}
