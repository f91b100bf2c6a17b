// Shares of the functions, solved apart and put together from parcels, are the functions solved
// together, bit by bit.
#include "private.h"

#include <fixtures/o_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/solved.hpp>
#include <fixtures/parts.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

struct Range {
    std::int32_t first = -1, n = -1;
};

// One process's share, with an analysis and a plan of its own.
class Share {
public:
    Attempt attempt;
    hm_basis* basis = nullptr;
    hm_solve_report report{};

    Share(KindOfProblem& problem, Range range) {
        report.struct_size = sizeof report;
        REQUIRE(attempt.analyse(problem.setup.problem(), &problem.options));
        REQUIRE(attempt.prepare());
        std::size_t bytes = 0;
        REQUIRE(hm_private_share_size(attempt.analysis, range.first, range.n, &bytes, nullptr) ==
                HM_OK);
        block_ = std::make_unique<Guarded>(bytes, 40);
        REQUIRE(hm_private_share_init(&basis, block_->data(), bytes, attempt.analysis, range.first,
                                      range.n, nullptr) == HM_OK);
        REQUIRE(hm_plan_factor(attempt.plan, nullptr, nullptr) == HM_OK);
        REQUIRE(hm_plan_solve(attempt.plan, basis, &report, nullptr) == HM_OK);
        CHECK(block_->guards_intact());
    }
    std::vector<double> parcel(std::vector<std::int32_t> const& points) const {
        std::int64_t doubles = 0;
        std::int32_t const n = std::int32_t(points.size());
        REQUIRE(hm_private_parcel_size(basis, n, &doubles, nullptr) == HM_OK);
        std::vector<double> out(std::size_t(doubles) + 1, -3.0);
        REQUIRE(hm_private_parcel_pack(basis, n, points.data(), out.data(), nullptr) == HM_OK);
        CHECK(out.back() == -3.0);  // not written
        out.pop_back();
        return out;
    }

private:
    std::unique_ptr<Guarded> block_;
};

hm_status unpack(Rows const& rows, std::vector<double> const& parcel, hm_error* error = nullptr) {
    return hm_private_parcel_unpack(rows.basis, parcel.data(), std::int64_t(parcel.size()), error);
}

}  // namespace

TEST_CASE("shares of any size make the rows of the whole basis, byte by byte") {
    for (KindOfProblem& problem : kinds_of_problems()) {
        Solved const solved(problem.setup, &problem.options);
        std::int32_t const n = solved.info().functions;
        std::vector<std::int32_t> const points = random_parts(solved.info().points, 3, 4)[0];
        std::vector<unsigned char> const expected = bytes_of(Rows(solved.basis, points).basis);
        for (std::int32_t const processes : {1, 2, 3, n + 2}) {
            std::vector<std::unique_ptr<Share>> shares;
            for (std::int32_t part = 0; part < processes; ++part) {
                Range range;
                REQUIRE(hm_private_share_of(solved.analysis, part, processes, &range.first,
                                            &range.n, nullptr) == HM_OK);
                CHECK((range.n == n / processes || range.n == (n - 1) / processes + 1));
                shares.push_back(std::make_unique<Share>(problem, range));
            }
            Rows const rows(shares.back()->basis, points);
            REQUIRE(rows.status == HM_OK);
            CHECK(info_of(rows.basis).solved ==
                  (processes == 1 ? 1 : 0));  // a share of everything needs no parcels
            for (std::unique_ptr<Share> const& share : shares)
                if (processes > 1) REQUIRE(unpack(rows, share->parcel(points)) == HM_OK);
            CHECK(bytes_of(rows.basis) == expected);
        }
    }
}

TEST_CASE("the report and the values of a share are those of the functions in the share") {
    KindOfProblem problem;
    problem.setup = two_body_case();
    Solved const solved(problem.setup);
    Share const share(problem, {8, 5});
    CHECK(share.report.functions == 5);
    CHECK(share.report.residual_function >= 8);
    CHECK(share.report.residual_function < 13);
    CHECK(share.report.residual > 0);
    CHECK(share.report.residual <= solved.report.residual);
    CHECK(share.report.boundary_error <= 1e-15);
    CHECK(share.report.partition_defect == 0);
    CHECK(share.report.max_value <= solved.report.max_value);
    CHECK(share.report.max_value > 0.5);
    std::vector<double> values(problem.setup.mesh.x.size());
    for (std::int32_t const function : {8, 12}) {
        CHECK(same_bits(values_of(share.basis, function), solved.values(function)));
    }
    for (std::int32_t const function : {7, 13, -1})
        CHECK(hm_basis_values(share.basis, function, 0, values.data(), nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("the memory of a share is proportional to the share") {
    KindOfProblem problem;
    problem.setup = two_body_case();
    Attempt attempt;
    REQUIRE(attempt.analyse(problem.setup.problem()));
    std::size_t none = 0, one = 0, five = 0, whole = 0, all = 0;
    REQUIRE(hm_private_share_size(attempt.analysis, 3, 0, &none, nullptr) == HM_OK);
    REQUIRE(hm_private_share_size(attempt.analysis, 3, 1, &one, nullptr) == HM_OK);
    REQUIRE(hm_private_share_size(attempt.analysis, 3, 5, &five, nullptr) == HM_OK);
    REQUIRE(hm_private_share_size(attempt.analysis, 0, 20, &whole, nullptr) == HM_OK);
    REQUIRE(fixtures::basis_size(attempt.analysis, &all, nullptr) == HM_OK);
    CHECK(whole == all);
    CHECK(five - none >= 5 * 8 * problem.setup.mesh.x.size());
    CHECK(five - none < 5 * 8 * (problem.setup.mesh.x.size() + 15) + 64);
    CHECK(one - none < 8 * (problem.setup.mesh.x.size() + 15) + 64);
}

TEST_CASE("refinement of a function does not depend on those solved with it") {
    // Very thin cells beside a free boundary on the right: rounding is felt most by the functions
    // that reach there.
    int const n = 24, n_control = 9;
    KindOfProblem problem;
    problem.setup.mesh = square(n);
    for (double& y : problem.setup.mesh.y) y *= 0.4;
    for (double& x : problem.setup.mesh.x)
        if (x == 1) x = 1 - 1.0 / n + 1e-7;
    Spline line;
    line.degree = 1;
    line.knots = clamped_knots(1, n_control);
    for (int k = 0; k < n_control; ++k)
        line.control.insert(line.control.end(), {k / (n_control - 1.0), 0.0});
    problem.setup.curves = line;
    problem.setup.put_on_curves(bottom);
    problem.setup.set_free(right);
    Solved const solved(problem.setup, &problem.options);
    CHECK(solved.report.refinements > 0);
    std::int32_t least = 100, most = 0;
    for (std::int32_t i = 0; i < n_control; ++i) {
        Share const share(problem, {i, 1});
        least = std::min(least, share.report.refinements);
        most = std::max(most, share.report.refinements);
        CHECK(same_bits(values_of(share.basis, i), solved.values(i)));
    }
    INFO(least << " to " << most << " steps");
    CHECK(most > 0);
    CHECK(least < most);
}

TEST_CASE("a function has the same bits in any share, on any threads, whatever is solved with it") {
    struct Method {
        std::int32_t operator_kind, scheme, engine;
    };
    Method const methods[] = {
        {HM_CONFORMAL, HM_COMPACT, HM_DIRECT},      {HM_LAPLACE, HM_COMPACT, HM_DIRECT},
        {HM_WEIGHTED, HM_COMPACT, HM_DIRECT},       {HM_WEIGHTED, HM_BOUNDED, HM_DIRECT},
        {HM_LAPLACE, HM_NODAL_GRADIENT, HM_DIRECT}, {HM_WEIGHTED, HM_COMPACT, HM_MULTIGRID},
        {HM_WEIGHTED, HM_COMPACT, HM_FAS},          {HM_LAPLACE, HM_NODAL_GRADIENT, HM_FAS}};
    std::vector<KindOfProblem> problems = kinds_of_problems();  // values of all kinds
    for (KindOfProblem& problem : problems)
        problem.setup.mesh = two_body_case(Cells::hybrid, 8, 5).mesh;
    problems.back().setup = airfoil_case(20, 10);
    problems.back().setup.mesh = c_mesh(naca4({}, 16), 6, 8, stretched(1e-3, 8, 12)).mesh;
    for (Method const& method : methods)
        for (KindOfProblem& problem : problems) {
            Options& options = problem.options;
            options = laplace();
            options.operator_kind = method.operator_kind;
            options.scheme = method.scheme;
            options.engine = method.engine;
            Attempt const attempt(problem.setup.problem(), &options);
            if (attempt.status == HM_UNSUPPORTED) continue;  // bodies that turn, points that slip
            Solved const all(problem.setup, &options);
            std::int32_t const n = all.info().functions;
            std::vector<double> const expected = values_in_shares(all, n);
            INFO("operator " << method.operator_kind << ", scheme " << method.scheme << ", engine "
                             << method.engine << ", problem " << &problem - &problems[0]);
            CHECK(same_bits(
                std::vector<double>(expected.begin(), expected.begin() + all.info().points),
                all.values(0)));
            CHECK(same_bits(values_in_shares(all, 3), expected));
            std::ptrdiff_t const numbers = static_cast<std::ptrdiff_t>(expected.size()) / n;
            for (std::int32_t const alone : {0, n / 2, n - 1}) {
                auto const begin = expected.begin() + alone * numbers;
                CHECK(same_bits(values_of_share(all, alone, 1),
                                std::vector<double>(begin, begin + numbers)));
            }
            Backwards order;
            hm_executor const executor = order.executor(3);
            options.executor = &executor;
            CHECK(same_bits(values_in_shares(Solved(problem.setup, &options), 7), expected));
        }
}

TEST_CASE("shares are refused where all functions are needed, and so are invalid ranges") {
    KindOfProblem problem;
    problem.setup = two_body_case();
    Share const share(problem, {0, 3});
    std::vector<double> x = problem.setup.mesh.x, move(40, 0.1);
    hm_error error{};
    CHECK(hm_morph(share.basis, move.data(), points_in(x, x), points_out(x, x), nullptr, &error) ==
          HM_BAD_BASIS);
    CHECK(says(error, "only 3 of the 20 functions"));
    CHECK(hm_adjoint(share.basis, points_in(x, x), move.data(), nullptr, nullptr) == HM_BAD_BASIS);
    std::size_t bytes = 0;
    std::int32_t const wrong[][2] = {{-1, 2}, {0, 21}, {19, 2},
                                     {21, 0}, {3, -1}, {2147483647, 2147483647}};
    for (auto const& refused : wrong)
        CHECK(hm_private_share_size(share.attempt.analysis, refused[0], refused[1], &bytes,
                                    &error) == HM_BAD_ARGUMENT);
    std::int32_t first = 0, n = 0;
    for (auto const& refused : {Range{0, 0}, Range{-1, 2}, Range{2, 2}})
        CHECK(hm_private_share_of(share.attempt.analysis, refused.first, refused.n, &first, &n,
                                  nullptr) == HM_BAD_ARGUMENT);
    hm_basis* made = nullptr;
    std::vector<unsigned char> block(64);
    CHECK(hm_private_share_init(&made, block.data(), 64, share.attempt.analysis, 0, 21, nullptr) ==
          HM_BAD_ARGUMENT);
    CHECK(made == nullptr);
}

TEST_CASE("parcels out of order, of other lists or problems, or truncated are refused") {
    KindOfProblem problem, other;
    problem.setup = two_body_case();
    other.setup = two_body_case(Cells::triangles);
    Share const first(problem, {0, 12}), second(problem, {12, 8}), foreign(other, {0, 12});
    std::vector<std::int32_t> const points{5, 3, 8}, fewer{5, 3};
    Rows const rows(first.basis, points);
    CHECK(info_of(rows.basis).solved == 0);
    hm_error error{};
    CHECK(unpack(rows, second.parcel(points), &error) == HM_BAD_BASIS);
    CHECK(error.item == 12);
    CHECK(std::string(error.text) ==
          "the parcel begins with function 12, but the next function to add is 0");
    CHECK(unpack(rows, foreign.parcel(points)) == HM_BAD_BASIS);
    CHECK(unpack(rows, first.parcel(fewer)) == HM_BAD_BASIS);
    std::vector<double> parcel = first.parcel(points);
    parcel.pop_back();
    CHECK(unpack(rows, parcel) == HM_BAD_BASIS);
    CHECK(unpack(rows, {1.0, 2.0}) == HM_BAD_BASIS);
    CHECK(unpack(rows, std::vector<double>(40, 1.0), &error) == HM_BAD_BASIS);
    CHECK(std::string(error.text) ==
          "the data are not a parcel of rows: the mark at their start is missing");
    CHECK(unpack(rows, first.parcel(points)) == HM_OK);
    CHECK(info_of(rows.basis).solved == 0);
    CHECK(unpack(rows, first.parcel(points)) == HM_BAD_BASIS);  // twice
    CHECK(unpack(rows, second.parcel(points)) == HM_OK);
    CHECK(info_of(rows.basis).solved == 1);
    CHECK(unpack(rows, second.parcel(points), &error) == HM_BAD_BASIS);
    CHECK(std::string(error.text) ==
          "the rows already contain all functions, so no parcel can be added");
    std::int64_t doubles = 0;
    CHECK(hm_private_parcel_size(first.basis, -1, &doubles, nullptr) == HM_BAD_ARGUMENT);
}

TEST_CASE("a parcel is for one list of points and one set of functions") {
    struct Sender {
        const char* what;
        std::int32_t operator_kind;
        double offset;  // change of one control point
        std::vector<std::int32_t> points;
        const char* refusal;  // "" if the parcel is taken
    };
    const char* const other_list =
        "the parcel was packed for another list of points than the list of the rows";
    const char* const other_problem =
        "the parcel comes from a basis of another problem: mesh, conditions, curves or method "
        "differ";
    Sender const senders[] = {
        {"the same", HM_LAPLACE, 0, {5, 3, 8}, ""},
        {"the same points in another order", HM_LAPLACE, 0, {3, 5, 8}, other_list},
        {"another point", HM_LAPLACE, 0, {5, 3, 9}, other_list},
        {"a point twice", HM_LAPLACE, 0, {5, 3, 3}, other_list},
        {"another operator with values of the same kind", HM_WEIGHTED, 0, {5, 3, 8}, other_problem},
        {"another control point", HM_LAPLACE, 1e-9, {5, 3, 8}, other_problem},
    };
    KindOfProblem problem;
    problem.setup = two_body_case();
    Share const first(problem, {0, 12}), second(problem, {12, 8});
    for (Sender const& sender : senders) {
        KindOfProblem changed = problem;
        changed.options.operator_kind = sender.operator_kind;
        changed.setup.curves.control[0] += sender.offset;
        Share const share(changed, {0, 12});
        Rows const rows(first.basis, {5, 3, 8});
        std::vector<unsigned char> const before = bytes_of(rows.basis);
        hm_error error{};
        hm_status const status = unpack(rows, share.parcel(sender.points), &error);
        INFO(sender.what << ": " << error.text);
        bool const is_taken = *sender.refusal == '\0';
        CHECK(status == (is_taken ? HM_OK : HM_BAD_BASIS));
        CHECK(std::string(error.text) == sender.refusal);
        if (!is_taken) {
            CHECK(bytes_of(rows.basis) == before);
            CHECK(unpack(rows, first.parcel({5, 3, 8})) == HM_OK);
        }
        CHECK(unpack(rows, second.parcel({5, 3, 8})) == HM_OK);
        CHECK(info_of(rows.basis).solved == 1);
    }
}

TEST_CASE("positions in an extract are another list than the numbers of the mesh") {
    KindOfProblem problem;
    problem.setup = two_body_case();
    Share const first(problem, {0, 12}), second(problem, {12, 8});
    Solved const whole(problem.setup, &problem.options);
    std::vector<std::int32_t> all;
    for (std::int32_t k = 0; k < problem.setup.mesh.n_points(); ++k) all.push_back(k);
    // The list of all points in their order is the mesh itself.
    Rows const of_all(first.basis, all);
    CHECK(unpack(of_all, first.parcel(all)) == HM_OK);
    CHECK(unpack(of_all, second.parcel(all)) == HM_OK);
    CHECK(info_of(of_all.basis).solved == 1);
    Rows const few(first.basis, {2, 1, 0});
    CHECK(unpack(few, first.parcel({0, 1, 2})) == HM_BAD_BASIS);
    Rows const nested(whole.basis, {2, 1, 0});
    Rows const same(nested.basis, {0, 1, 2}), turned(nested.basis, {2, 1, 0});
    std::int64_t doubles = 0;
    REQUIRE(hm_private_parcel_size(nested.basis, 3, &doubles, nullptr) == HM_OK);
    std::vector<double> parcel(static_cast<std::size_t>(doubles));
    std::int32_t const in_order[] = {0, 1, 2};
    REQUIRE(hm_private_parcel_pack(nested.basis, 3, in_order, parcel.data(), nullptr) == HM_OK);
    CHECK(unpack(few, parcel) == HM_OK);  // all functions of the points 2, 1, 0
    for (std::int32_t function : {0, 7, 19}) {
        std::vector<double> const own = values_of(few.basis, function);
        CHECK(same_bits(own, values_of(same.basis, function)));
        CHECK(own[0] == values_of(turned.basis, function)[2]);
    }
}
