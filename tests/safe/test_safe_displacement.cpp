// Given displacements by the strategies of a safe morph: all of the way with the given bits, or how far and why.
#include <doctest/doctest.h>

#include <fixtures/derived.hpp>
#include <fixtures/displaced.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/half_ring.hpp>
#include <fixtures/naca0012.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

double const pi = std::acos(-1.0);

// A block of 5 x 3 cells in a square.
Case block(Cells kind = Cells::quads, int n = 25) {
    Case out;
    out.mesh = square(n, kind, 5, 3);
    out.set_given(body);
    return out;
}

// One call of hm_displace_safe, with the basis of the case or a derived one.
class SafeDisplaced : public Displaced {
public:
    hm_safe_options safe_options{};
    hm_safe_report safe_report{};
    std::vector<double> x, y;
    Mesh mesh;

    explicit SafeDisplaced(Case& its, hm_options const& options = options_of(HM_CONFORMAL))
        : Displaced(its, &options), mesh(its.mesh) {
        safe_options.struct_size = sizeof safe_options;
        safe_options.min_quality = -1;
    }
    hm_status run(Field const& wall, std::vector<double> const* move = nullptr, const hm_basis* with = nullptr) {
        const hm_basis* const by = with != nullptr ? with : basis;
        std::size_t bytes = 0;
        error = {};
        status = hm_displace_safe_size(plan, by, &bytes, &error);
        x = mesh.x;
        y = mesh.y;
        if (status < 0) return status;
        Guarded work(bytes);
        safe_report = {};
        safe_report.struct_size = sizeof safe_report;
        const double* const values = reinterpret_cast<const double*>(wall.data());
        hm_points const given{values, values + 1, 2};
        status = hm_displace_safe(plan, by, move != nullptr ? move->data() : nullptr,
                                  static_cast<std::int32_t>(wall.size()), nullptr, &given, points_out(x, y),
                                  work.data(), bytes, &safe_options, &safe_report, &error);
        CHECK(work.guards_intact());
        CHECK(error.code == status);
        if (status >= 0) CHECK(check(moved_mesh()).min_corner > 0);
        return status;
    }
    Mesh moved_mesh() const {
        Mesh out = mesh;
        out.x = x;
        out.y = y;
        return out;
    }
    Field start() const {
        Field out;
        for (std::int32_t const point : points) {
            auto const k = static_cast<std::size_t>(point);
            out.push_back({mesh.x[k], mesh.y[k]});
        }
        return out;
    }
    Field similarity(Complex ratio, Complex centre, Complex shift = 0) const {
        Field out;
        for (Complex const z : start()) out.push_back((ratio - 1.0) * (z - centre) + shift);
        return out;
    }
    // The wall, bit by bit.
    bool is_at(Field const& wall) const {
        for (std::size_t k = 0; k < points.size(); ++k) {
            auto const at = static_cast<std::size_t>(points[k]);
            if (x[at] != mesh.x[at] + wall[k].real() || y[at] != mesh.y[at] + wall[k].imag()) return false;
        }
        return true;
    }
    bool untouched() const { return same_bits(x, mesh.x) && same_bits(y, mesh.y); }
};

}  // namespace

TEST_CASE("a displacement that is possible in one step is that of hm_displace") {
    for (std::int32_t const kind : {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL}) {
        Case its = block(Cells::hybrid);
        SafeDisplaced safe(its, options_of(kind));
        Field wall = some_field(safe.points.size(), 3, 2e-3);
        for (Complex& w : wall) w += Complex(0.03, -0.01);
        Field const expected = safe.displace(wall);
        REQUIRE(safe.run(wall) == HM_OK);
        CHECK(safe.safe_report.strategy == HM_STRATEGY_LINEAR);
        CHECK(safe.safe_report.resolves == 0);
        CHECK(safe.safe_report.step_fraction == 1);
        CHECK(safe.is_at(wall));
        for (std::size_t k = 0; k < expected.size(); ++k) {
            CHECK(std::fabs(safe.x[k] - its.mesh.x[k] - expected[k].real()) < 1e-14);
            CHECK(std::fabs(safe.y[k] - its.mesh.y[k] - expected[k].imag()) < 1e-14);
        }
        REQUIRE(safe.run(Field(wall.size())) == HM_OK);
        CHECK(safe.untouched());
    }
}

TEST_CASE("a rotation of 150 degrees with a change of shape: with the given bits, by every operator and engine") {
    for (int const variant : {0, 1, 2, 3}) {
        Case its = block(variant == 1 ? Cells::triangles : Cells::quads);
        hm_options options = options_of(variant == 1 ? HM_LAPLACE : variant == 2 ? HM_WEIGHTED : HM_CONFORMAL);
        if (variant == 3) options = options_of(HM_LAPLACE), options.engine = HM_MULTIGRID;
        SafeDisplaced safe(its, options);
        Field wall = safe.similarity(std::polar(1.1, 150 * pi / 180), {0.5, 0.5}, {0.02, 0.05});
        Field const start = safe.start();
        for (std::size_t k = 0; k < wall.size(); ++k) wall[k] += 0.01 * std::sin(20 * start[k].real());
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

TEST_CASE("rotated in steps, a body keeps its shape on the way: fewer cells suffer than on straight lines") {
    Case its = block();
    SafeDisplaced safe(its);
    Field const half = safe.similarity(std::polar(1.0, 178 * pi / 180), {0.5, 0.5});
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_UNTANGLED, HM_STRATEGY_OTHER, HM_STRATEGY_IMPROVED});
    safe.safe_options.max_resolves = 30;
    REQUIRE(safe.run(half) == HM_OK);   // straight lines would pass through a body of no size
    CHECK(safe.safe_report.strategy == HM_STRATEGY_SUBSTEPS);
    CHECK(safe.is_at(half));
}

TEST_CASE("the functions of another operator are solved where one step of the first one is not enough") {
    Case its = block();
    SafeDisplaced safe(its, options_of(HM_CONFORMAL, 16));
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
    bool helped = false;
    for (double shift = 0.05; shift < 0.5 && !helped; shift += 0.01) {
        Field const wall(safe.points.size(), Complex(shift, 0));
        if (safe.run(wall) != HM_OK || safe.safe_report.strategy != HM_STRATEGY_OTHER) continue;
        helped = true;
        CHECK(safe.safe_report.resolves > 0);
        CHECK((safe.safe_report.other == HM_CONFORMAL || safe.safe_report.other == HM_LAPLACE));
        CHECK(safe.is_at(wall));
        safe.safe_options.skipped_strategies |= without({HM_STRATEGY_OTHER});
        CHECK(safe.run(wall) == HM_SHORT);
        CHECK(safe.safe_report.step_fraction < 1);
        CHECK(safe.safe_report.step_fraction > 0);
    }
    CHECK(helped);
}

TEST_CASE("given points beside a curve: both bodies turn, and each wall is where its own description has it") {
    Case its = two_body_case(Cells::hybrid, 12, 8);
    its.conditions.pop_back();
    its.set_given(second_body);
    hm_options const options = options_of(HM_CONFORMAL);
    SafeDisplaced safe(its, options);
    REQUIRE(hm_plan_solve(safe.plan, safe.basis, nullptr, nullptr) == HM_OK);
    hm_basis_info const info = info_of(safe.basis);
    Field const start = safe.start();
    Complex centre = 0;
    for (Complex const z : start) centre += z / static_cast<double>(start.size());
    Field const wall = safe.similarity(std::polar(1.0, -50 * pi / 180), centre);
    std::vector<double> move(2 * static_cast<std::size_t>(info.functions));   // the first curve up
    for (std::int32_t const i : its.curves.shapes[0].indices) move[2 * static_cast<std::size_t>(i) + 1] = 0.03;
    std::vector<double> reached(move.size());
    safe.safe_options.reached = reached.data();
    REQUIRE_MESSAGE(safe.run(wall, &move) == HM_OK, safe.error.text);
    CHECK(safe.is_at(wall));
    CHECK(reached == move);
    double error = 1;
    REQUIRE(hm_boundary_error(safe.basis, move.data(), points_in(safe.mesh.x, safe.mesh.y), points_in(safe.x, safe.y),
                              &error, nullptr, nullptr) == HM_OK);
    CHECK(std::fabs(error - safe.safe_report.turned_offset) < 1e-14);

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

TEST_CASE("a wall that ends on a line along which points slide goes straight, and slides with it") {
    Case its = given_instead(half_ring(8, 16, Cells::quads, 0, 4));
    for (std::int32_t const kind : {HM_LAPLACE, HM_CONFORMAL}) {
        SafeDisplaced safe(its, options_of(kind));
        Field const start = safe.start();
        Field wall;
        for (Complex const z : start) wall.push_back(Complex(0.75 * z.real(), -0.4 * z.imag()));
        REQUIRE_MESSAGE(safe.run(wall) == HM_OK, safe.error.text);
        CHECK(safe.is_at(wall));
        for (std::size_t k = 0; k < safe.x.size(); ++k)
            if (its.mesh.y[k] == 0) CHECK(safe.y[k] == 0);
    }
}

TEST_CASE("threads and the order of the list do not change a bit") {
    Case its = block();
    SafeDisplaced one(its);
    Field const wall = one.similarity(std::polar(1.0, 100 * pi / 180), {0.5, 0.5});
    REQUIRE(one.run(wall) == HM_OK);
    Backwards backwards;
    hm_executor const executor = backwards.executor(3);
    hm_options options = options_of(HM_CONFORMAL);
    options.executor = &executor;
    SafeDisplaced three(its, options);
    REQUIRE(three.run(wall) == HM_OK);
    CHECK(same_bits(one.x, three.x));
    CHECK(same_bits(one.y, three.y));
    // reversed list, with its first point twice
    std::vector<std::int32_t> list(one.points.rbegin(), one.points.rend());
    Field reversed(wall.rbegin(), wall.rend());
    list.push_back(list[0]);
    reversed.push_back(reversed[0]);
    std::size_t bytes = 0;
    REQUIRE(hm_displace_safe_size(one.plan, one.basis, &bytes, nullptr) == HM_OK);
    Guarded work(bytes);
    const double* const values = reinterpret_cast<const double*>(reversed.data());
    hm_points const given{values, values + 1, 2};
    std::vector<double> x = its.mesh.x, y = its.mesh.y;
    REQUIRE(hm_displace_safe(one.plan, one.basis, nullptr, static_cast<std::int32_t>(list.size()), list.data(), &given,
                             points_out(x, y), work.data(), bytes, &one.safe_options, nullptr, nullptr) == HM_OK);
    CHECK(same_bits(one.x, x));
    CHECK(same_bits(one.y, y));
}

TEST_CASE("not all of the way: how far, and the cell that stands in the way; poor cells are named") {
    Case its = block();
    SafeDisplaced safe(its);
    Field const wall(safe.points.size(), Complex(0.35, 0));   // into the corner cells of the side
    safe.safe_options.max_resolves = -1;
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_OTHER, HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(wall) == HM_SHORT);
    double const part = safe.safe_report.step_fraction;
    CHECK(part > 0);
    CHECK(part < 1);
    CHECK(safe.error.value == doctest::Approx(part));
    CHECK(safe.safe_report.cell >= 0);
    for (std::size_t k = 0; k < safe.points.size(); ++k) {
        auto const at = static_cast<std::size_t>(safe.points[k]);
        CHECK(safe.x[at] - safe.mesh.x[at] == doctest::Approx(part * wall[k].real()).epsilon(1e-12));
    }
    safe.safe_options = {};
    safe.safe_options.struct_size = sizeof safe.safe_options;
    safe.safe_options.min_quality = 0.999;
    Field const little(safe.points.size(), Complex(0.05, 0));
    CHECK(safe.run(little) == HM_POOR);
    CHECK(safe.is_at(little));
    CHECK(safe.error.item == safe.safe_report.worst[0].cell);
}

TEST_CASE("given displacements: heights of the first layer are limited where that is asked for, and the place said") {
    Case its;
    its.mesh = o_mesh(naca4({}, 40), stretched(1e-3, 8, 24));
    its.set_given(body);
    SafeDisplaced safe(its);
    Field wall;
    for (Complex const z : safe.start()) wall.push_back({0, 0.4 * z.real() * (1 - z.real())});   // a camber of .1
    REQUIRE(safe.run(wall) == HM_OK);
    double const change = std::max(safe.safe_report.max_height_ratio, 1 / safe.safe_report.min_height_ratio);
    REQUIRE(change > 1.1);
    safe.safe_options.max_height_change = 1 + 0.5 * (change - 1);
    REQUIRE(safe.run(wall) == HM_OK);
    CHECK(safe.is_at(wall));
    CHECK(safe.safe_report.max_height_ratio <= safe.safe_options.max_height_change);
    CHECK(safe.safe_report.min_height_ratio >= 1 / safe.safe_options.max_height_change);
    safe.safe_options.max_height_change = std::nextafter(1.0, 2.0);
    CHECK(safe.run(wall) == HM_POOR);
    CHECK(safe.is_at(wall));
    CHECK(std::string(safe.error.text).find("the height of the first layer at point") != std::string::npos);
    CHECK(std::find(safe.points.begin(), safe.points.end(), safe.error.item) != safe.points.end());
    safe.safe_options.max_height_change = 0.5;
    CHECK(safe.run(wall) == HM_BAD_ARGUMENT);
    CHECK(safe.untouched());
}

TEST_CASE("what cannot be is refused by name, and nothing is written") {
    Case its = block();
    SafeDisplaced safe(its);
    Field const good(safe.points.size(), Complex(0.01, 0));
    auto const refusal = [&](Field const& wall, hm_status expected, std::string const& word, std::int32_t item) {
        CHECK(safe.run(wall) == expected);
        CHECK_MESSAGE(std::string(safe.error.text).find(word) != std::string::npos, safe.error.text);
        CHECK(safe.error.item == item);
        CHECK(safe.untouched());
    };
    Field crossing = good;
    crossing[0] += Complex(0.3, 0.2);
    CHECK(safe.run(crossing) == HM_CROSSING);
    CHECK(safe.untouched());
    CHECK(safe.safe_report.crossing_points[0] >= 0);
    Field bad = good;
    Untrapped const untrapped;   // comparisons with a number that is none
    bad[2] = {0, std::nan("")};
    refusal(bad, HM_BAD_ARGUMENT, "is not finite", safe.points[2]);
    bad[2] = 1e101;
    refusal(bad, HM_BAD_ARGUMENT, "beyond 1e100", safe.points[2]);
    refusal(Field(good.begin(), good.end() - 1), HM_BAD_ARGUMENT, "points have given displacements",
            static_cast<std::int32_t>(good.size()) - 1);
    CHECK(safe.run(Field(good.size(), Complex(5, 0))) == HM_CROSSING);
    CHECK(std::string(safe.error.text).find("outside") != std::string::npos);
    CHECK(safe.untouched());
    safe.safe_options.n_others = 1;
    refusal(good, HM_BAD_ARGUMENT, "others", 1);
    safe.safe_options.n_others = 0;
    safe.safe_options.min_quality = 2;
    refusal(good, HM_BAD_ARGUMENT, "min_quality", -1);
    safe.safe_options.min_quality = 0;

    Case with_curve = two_body_case(Cells::hybrid, 8, 6);
    Attempt const curves(with_curve.problem());
    std::size_t bytes = 0;
    hm_error error{};
    CHECK(hm_displace_safe_size(curves.plan, curves.basis, &bytes, &error) == HM_BAD_CONDITION);
    with_curve.conditions.pop_back();
    with_curve.set_given(second_body);
    Attempt unsolved;
    REQUIRE(unsolved.analyse(with_curve.problem()));
    REQUIRE(unsolved.prepare());
    CHECK(hm_displace_safe_size(unsolved.plan, unsolved.basis, &bytes, &error) == HM_BAD_BASIS);
    CHECK(hm_displace_safe_size(unsolved.plan, safe.basis, &bytes, &error) == HM_BAD_BASIS);
    CHECK(hm_displace_safe_size(nullptr, safe.basis, &bytes, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe_size(safe.plan, nullptr, &bytes, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe_size(safe.plan, safe.basis, nullptr, &error) == HM_BAD_ARGUMENT);
    REQUIRE(hm_displace_safe_size(safe.plan, safe.basis, &bytes, &error) == HM_OK);
    Guarded work(bytes);
    std::vector<double> x = its.mesh.x, y = its.mesh.y;
    const double* const values = reinterpret_cast<const double*>(good.data());
    hm_points const wall{values, values + 1, 2};
    auto const n = static_cast<std::int32_t>(good.size());
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, &wall, points_out(x, y), work.data(), bytes - 1,
                           nullptr, nullptr, &error) == HM_BLOCK_TOO_SMALL);
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, nullptr, points_out(x, y), work.data(), bytes,
                           nullptr, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, &wall, nullptr, work.data(), bytes, nullptr,
                           nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, nullptr, &wall, points_out(x, y), nullptr, bytes, nullptr,
                           nullptr, &error) == HM_BAD_ARGUMENT);
    std::vector<std::int32_t> twice = safe.points;
    twice[1] = twice[0];
    CHECK(hm_displace_safe(safe.plan, safe.basis, nullptr, n, twice.data(), &wall, points_out(x, y), work.data(), bytes,
                           nullptr, nullptr, &error) == HM_BAD_CONDITION);
    CHECK(same_bits(x, its.mesh.x));
    CHECK(same_bits(y, its.mesh.y));
}

TEST_CASE("safe morphs by combined functions and by modes: large, valid, at the target") {
    Case its = two_body_case(Cells::hybrid, 12, 8);
    hm_options const options = options_of(HM_CONFORMAL);
    Safe reference(its, options);
    hm_basis_info const info = reference.solved().info();
    // Two variables: all control points along x, and along y times their own x.
    Combination matrix(info.control_points, 2, 1, 1);
    for (int i = 0; i < matrix.rows; ++i) {
        auto const k = static_cast<std::size_t>(2 * i);
        matrix.entries[k] = 1;
        matrix.entries[k + 1] = its.curves.control[k];
    }
    Combined const combined(reference.solved().basis, matrix);
    REQUIRE(combined.status == HM_OK);
    std::size_t bytes = 0, whole_bytes = 0;
    hm_plan* const plan = reference.solved().plan;
    REQUIRE(hm_morph_safe_size(plan, combined.basis, &bytes, nullptr) == HM_OK);
    REQUIRE(hm_morph_safe_size(plan, nullptr, &whole_bytes, nullptr) == HM_OK);
    CHECK(bytes < whole_bytes);
    Guarded work(bytes);
    std::vector<double> move = {0.02, 0, 0, 0.1};
    hm_safe_options safe_options = reference.safe_options;
    safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
    hm_safe_report report{};
    report.struct_size = sizeof report;
    std::vector<double> x = its.mesh.x, y = its.mesh.y, reached(move.size());
    safe_options.reached = reached.data();
    hm_error error{};
    Combined const sum(reference.solved().basis, matrix);
    REQUIRE_MESSAGE(hm_morph_safe(plan, combined.basis, move.data(), points_out(x, y), sum.basis, work.data(), bytes,
                                  &safe_options, &report, &error) == HM_OK,
                    error.text);
    CHECK(report.strategy == HM_STRATEGY_SUBSTEPS);
    CHECK(report.resolves > 0);
    CHECK(reached == move);
    Mesh moved = its.mesh;
    moved.x = x;
    moved.y = y;
    CHECK(check(moved).min_corner > 0);
    double off = 1;
    REQUIRE(hm_boundary_error(combined.basis, move.data(), points_in(its.mesh.x, its.mesh.y), points_in(x, y), &off,
                              nullptr, nullptr) == HM_OK);
    CHECK(off < 1e-14);
    // The derivative at the wall is that of the combined functions.
    Moved const slope = displaced(sum.basis, move), expected = displaced(combined.basis, move);
    for (std::int32_t slot = 0; slot < info.curve_points; ++slot) {
        auto const at = static_cast<std::size_t>(info.curve_point[slot]);
        CHECK(slope.x[at] == doctest::Approx(expected.x[at]).epsilon(1e-12));
        CHECK(slope.y[at] == doctest::Approx(expected.y[at]).epsilon(1e-12));
    }
    // With the whole functions' derivative it does not fit together.
    CHECK(hm_morph_safe(plan, combined.basis, move.data(), points_out(x, y),
                        const_cast<hm_basis*>(reference.solved().basis), work.data(), bytes, &safe_options, nullptr,
                        &error) == HM_BAD_BASIS);

    Case table = its;
    table.conditions.pop_back();
    table.set_given(second_body);
    Attempt solved(table.problem(), &options);
    REQUIRE(solved.status == HM_OK);
    std::vector<std::int32_t> const points = given_points(solved.plan);
    Field mode;
    for (std::int32_t const point : points) {
        auto const k = static_cast<std::size_t>(point);
        mode.push_back({its.mesh.y[k], 0.3});
    }
    Tabulated const tabulated(solved.plan, solved.basis, {mode}, 2);
    REQUIRE(tabulated.status == HM_OK);
    REQUIRE(hm_morph_safe_size(solved.plan, tabulated.basis, &bytes, nullptr) == HM_OK);
    Guarded more(bytes);
    std::vector<double> amplitudes(2 * static_cast<std::size_t>(info_of(tabulated.basis).functions));
    amplitudes[amplitudes.size() - 2] = 0.2;
    amplitudes[amplitudes.size() - 1] = 0.1;
    safe_options.reached = nullptr;
    x = its.mesh.x;
    y = its.mesh.y;
    REQUIRE_MESSAGE(hm_morph_safe(solved.plan, tabulated.basis, amplitudes.data(), points_out(x, y), nullptr, more.data(),
                                  bytes, &safe_options, &report, &error) == HM_OK,
                    error.text);
    CHECK(report.strategy == HM_STRATEGY_SUBSTEPS);
    moved.x = x;
    moved.y = y;
    CHECK(check(moved).min_corner > 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
        auto const at = static_cast<std::size_t>(points[k]);
        Complex const by = Complex(0.2, 0.1) * mode[k];
        CHECK(std::fabs(x[at] - its.mesh.x[at] - by.real()) < 1e-15);
        CHECK(std::fabs(y[at] - its.mesh.y[at] - by.imag()) < 1e-15);
    }
}
