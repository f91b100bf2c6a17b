// hm_recover_movement: the movement is found again from where the points of the wall are.
#include <harmorph_design.h>

#include <fixtures/single.hpp>
#include <fixtures/fitted.hpp>
#include <fixtures/refused.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

// The result of the call for a mesh with points at x and y.
struct Recovered {
    std::vector<double> move;
    double residual = -1, rotated_offset = -1;
    std::int32_t point = -7;
    hm_error error{};
    hm_status status = HM_OK;

    Recovered(const hm_basis* basis, std::vector<double> const& x, std::vector<double> const& y,
              double tolerance = 0) {
        hm_basis_info const info = info_of(basis);
        Guarded work = block_of(fixtures::recover_movement_size, basis);
        move.assign(2 * std::size_t(info.functions), 7.5);
        hm_recover_report report = sized<hm_recover_report>();
        report.residual = report.rotated_offset = -1;
        report.point = -7;
        status = hm_recover_movement(basis, points_in(x, y), tolerance, move.data(), &report,
                                     fixtures::Memory(work.data(), work.size()), &error);
        residual = report.residual;
        rotated_offset = report.rotated_offset;
        point = report.point;
        CHECK(work.guards_intact());
    }
};

double norm(std::vector<double> const& numbers) {
    double sum = 0;
    for (double const number : numbers) sum += number * number;
    return std::sqrt(sum);
}

// Returns the largest distance of the first n_wall points from where a morph from the start leads
// them.
double distance_of_morph(const hm_basis* basis, Mesh const& start, std::vector<double> const& move,
                         std::vector<double> const& x, std::vector<double> const& y,
                         std::vector<std::int32_t> const& wall) {
    std::vector<double> to_x = start.x, to_y = start.y;
    REQUIRE(hm_morph(basis, move.data(), points_in(to_x, to_y), points_out(to_x, to_y), nullptr,
                     nullptr) == HM_OK);
    double worst = 0;
    for (std::int32_t const point : wall) {
        auto const k = std::size_t(point);
        worst = std::fmax(worst, std::hypot(x[k] - to_x[k], y[k] - to_y[k]));
    }
    return worst;
}

// A ring of few cells; its two circles are on curves of few control points, with offsets.
struct SmallProblem {
    Case setup;
    std::vector<std::int32_t> wall;

    explicit SmallProblem(std::mt19937& random) {
        int const n_t = 3 + int(random() % 7), inner = 4 + int(random() % 4);
        int const outer = 3 + int(random() % 3);
        setup.mesh = annulus(2, n_t, 1, 3);
        setup.curves.add(ring(3, inner, 1.1, 0.9));
        setup.curves.add(ring(2, outer, 3.2, 3.1));
        setup.put_on_curves(body, 0);
        setup.put_on_curves(far_field, 1);
        for (int k = 0; k < n_t; ++k) {
            setup.give(k, ring_parameter(3, inner, 2 * pi * k / n_t), 0);
            setup.give(2 * n_t + k, ring_parameter(2, outer, 2 * pi * k / n_t), 1);
            wall.insert(wall.end(), {k, 2 * n_t + k});
        }
    }
};

// Two movements, one after the other, are recovered as their sum, but for functions first ..
// last-1, on which no point of the wall depends.
void check_sum(const hm_basis* basis, Mesh const& mesh, std::int32_t functions,
               double exactness = 1e-12, std::size_t first = 0, std::size_t last = 0) {
    std::vector<double> x = mesh.x, y = mesh.y, sum(2 * std::size_t(functions));
    for (unsigned const seed : {1u, 2u}) {
        std::vector<double> const move = some_move(functions, 0.01, seed);
        REQUIRE(hm_morph(basis, move.data(), points_in(x, y), points_out(x, y), nullptr, nullptr) ==
                HM_OK);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += move[k];
    }
    Recovered const found(basis, x, y);
    INFO(found.error.text);
    REQUIRE(found.status == HM_OK);
    CHECK(found.residual < 1e-14);
    for (std::size_t k = 2 * first; k < 2 * last; ++k) CHECK(found.move[k] == 0);
    for (std::size_t k = 2 * first; k < 2 * last; ++k) sum[k] = 0;
    CHECK(largest_difference(found.move, sum) < exactness);
}

}  // namespace

TEST_CASE("the movement so far is the sum of all morphs for every kind of basis") {
    struct Row {
        const char* name;
        Case setup;
        std::int32_t operator_kind, offset_correction;
        std::size_t first = 0, last = 0;  // control points of a curve without points
    };
    std::vector<Row> rows = {{"a tied trailing edge", airfoil_case(), HM_CONFORMAL, 0},
                             {"offsets in the functions", airfoil_case(), HM_CONFORMAL, 1},
                             {"real values", airfoil_case(), HM_LAPLACE, 0},
                             {"a periodic curve", ring_case(6, 32, 1, 4), HM_CONFORMAL, 0},
                             {"two bodies", two_body_case(), HM_CONFORMAL, 0},
                             {"numbers from 1", two_body_case(), HM_LAPLACE, 0}};
    rows.back().setup.index_base = 1;
    Case rigid = two_body_case();
    rigid.conditions.pop_back();
    rigid.set_rigid(second_body, 1.5, 0.5);
    rows.push_back({"a curve and a rigid body", rigid, HM_CONFORMAL, 0, 11, 20});
    Case slips = two_body_case();
    slips.set_slip(far_field);
    rows.push_back({"values that are matrices", slips, HM_CONFORMAL, 0});
    for (Row& row : rows) {
        INFO(std::string(row.name));
        Options options = options_of(row.operator_kind);
        options.offset_correction = row.offset_correction;
        Solved solved(row.setup.problem(), &options);
        REQUIRE(solved.status >= 0);
        hm_basis_info const info = info_of(solved.basis);
        check_sum(solved.basis, row.setup.mesh, info.functions, 1e-12, row.first, row.last);
        Recovered const start(solved.basis, row.setup.mesh.x, row.setup.mesh.y);
        CHECK(start.status == HM_OK);
        CHECK(largest_difference(start.move, std::vector<double>(start.move.size())) == 0);
        Single const single(solved.basis);
        check_sum(single.basis, row.setup.mesh, info.functions, 1e-12, row.first, row.last);
    }
}

TEST_CASE("the movement so far of a rigid body is found in any unit of length") {
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        for (double const unit : {1e-60, 1e-8, 1.0, 1e60}) {
            INFO(operator_kind, ' ', unit);
            Case setup;
            setup.mesh = annulus(4, 12, unit, 3 * unit);
            setup.set_rigid(body, 0.5 * unit, 0.25 * unit);
            Solved solved(setup.problem(), options_of(operator_kind));
            REQUIRE(solved.status >= 0);
            // A translation in units of length, and s - 1 of a rotation with a scale.
            std::vector<double> const move = {0.3 * unit, -0.2 * unit, 0.1, 0.4};
            std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
            REQUIRE(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr,
                             nullptr) == HM_OK);
            Recovered const found(solved.basis, x, y);
            INFO(found.error.text);
            REQUIRE(found.status == HM_OK);
            CHECK(found.residual < 1e-14 * unit);
            for (std::size_t k = 0; k < 4; ++k)
                CHECK(std::fabs(found.move[k] - move[k]) < 1e-12 * (k < 2 ? unit : 1));
        }
    }
}

TEST_CASE("the movement so far is found for design variables and for modes at given points") {
    Case setup = curve_and_table();
    Solved solved(setup.problem(), options_of(HM_CONFORMAL));
    REQUIRE(solved.status >= 0);
    Combination const by(20, 4, 2, 3);  // the second curve has no points
    Combined const combined(solved.basis, by);
    REQUIRE(combined.status == HM_OK);
    check_sum(combined.basis, setup.mesh, 4, 1e-11);
    auto const n = given_points(solved.plan).size();
    std::vector<Field> modes(2, Field(n));
    for (std::size_t k = 0; k < n; ++k) {
        modes[0][k] = {0.3, 0.1 * std::cos(0.2 * double(k))};
        modes[1][k] = {std::sin(0.3 * double(k)), 0};
    }
    Tabulated const tabulated(solved.plan, solved.basis, modes, 2);
    REQUIRE(tabulated.status >= 0);
    check_sum(tabulated.basis, setup.mesh, 22, 1e-12, 11, 20);
    // Without modes, given points may be anywhere.
    std::vector<double> x = setup.mesh.x;
    for (std::int32_t const point : given_points(solved.plan)) x[std::size_t(point)] += 0.05;
    Recovered const without(solved.basis, x, setup.mesh.y);
    CHECK(without.status == HM_OK);
    CHECK(without.residual == 0);
}

TEST_CASE("the movement so far is found after safe morphs, which turn the offsets of the wall") {
    Case setup;
    Outline const outline = naca4({}, 40);
    setup.mesh = o_mesh(outline, stretched(1e-6, 8, 40));
    setup.curves = fitted_loop(outline.points, 12);
    setup.put_on_curves(body);
    Safe safe(setup);
    safe.safe_options.min_quality = 0;
    REQUIRE(safe.solved().report.max_distance > 1e-4);
    std::vector<double> const move = similarity_move(setup.curves, std::polar(1.0, 1.0), 0.25);
    REQUIRE(safe.run(move) == HM_OK);
    REQUIRE(safe.report.rotated_offset > 1e-4);
    Recovered const found(safe.solved().basis, safe.x, safe.y);
    REQUIRE(found.status == HM_OK);
    CHECK(found.rotated_offset == doctest::Approx(safe.report.rotated_offset).epsilon(1e-9));
    CHECK(found.residual == doctest::Approx(found.rotated_offset).epsilon(1e-9));
    CHECK(largest_difference(found.move, move) < 1e-10);
    CHECK(distance_of_morph(safe.solved().basis, setup.mesh, found.move, safe.x, safe.y,
                            points_on(setup.mesh, body)) ==
          doctest::Approx(found.residual).epsilon(1e-9));
}

TEST_CASE("of several movements that lead the wall to its place the smallest one is found") {
    Case setup = ring_case(6, 12, 1, 4);  // 12 points for 60 control points
    setup.curves = ring(3, 60, 1, 1);
    setup.conditions.clear();
    setup.put_on_curves(body);
    setup.known_points.clear();
    setup.known_curves.clear();
    setup.known_u.clear();
    for (int k = 0; k < 12; ++k) setup.give(k, ring_parameter(3, 60, 2 * pi * k / 12));
    Solved solved(setup.problem(), options_of(HM_CONFORMAL));
    REQUIRE(solved.status >= 0);
    std::vector<double> const move = some_move(60, 0.02, 5);
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    REQUIRE(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr,
                     nullptr) == HM_OK);
    Recovered const found(solved.basis, x, y);
    REQUIRE(found.status == HM_OK);
    CHECK(found.residual < 1e-14);
    CHECK(found.rotated_offset == 0);
    CHECK(norm(found.move) < norm(move));
    // The smallest movement is orthogonal to all movements that leave the wall where it is, such as
    // the difference of the two.
    double product = 0;
    for (std::size_t k = 0; k < found.move.size(); ++k)
        product += found.move[k] * (move[k] - found.move[k]);
    CHECK(std::abs(product) < 1e-5 * norm(move) * norm(move));
    int unused = 0;
    for (std::int32_t i = 0; i < 60; ++i) {
        std::vector<double> values(setup.mesh.x.size());
        REQUIRE(hm_basis_values(solved.basis, i, 0, values.data(), nullptr) == HM_OK);
        bool moves = false;
        for (std::size_t k = 0; k < 12; ++k) moves = moves || values[k] != 0;
        if (moves) continue;
        ++unused;
        CHECK(found.move[2 * std::size_t(i)] == 0);
        CHECK(found.move[2 * std::size_t(i) + 1] == 0);
    }
    CHECK(unused > 0);
}

TEST_CASE("a morph by the recovered movement leaves the wall as far away as the call says") {
    std::mt19937 random(52);
    int found_after_morph = 0, accepted_elsewhere = 0, turned = 0;
    for (int trial = 0; trial < 150; ++trial) {
        INFO(trial);
        SmallProblem small(random);
        Solved solved(small.setup.problem(), options_of(HM_CONFORMAL));
        REQUIRE(solved.status >= 0);
        Mesh const& mesh = small.setup.mesh;
        hm_basis_info const info = info_of(solved.basis);
        std::vector<double> const move = some_move(info.functions, 0.3, unsigned(trial));
        std::vector<double> x = mesh.x, y = mesh.y;
        REQUIRE(hm_morph(solved.basis, move.data(), points_in(x, y), points_out(x, y), nullptr,
                         nullptr) == HM_OK);
        Recovered const morphed(solved.basis, x, y);
        REQUIRE(morphed.status == HM_OK);
        CHECK(morphed.residual < 1e-13);
        CHECK(norm(morphed.move) < (1 + 1e-6) * norm(move));
        ++found_after_morph;
        // Places to which no morph leads. With as many functions as points there is a movement.
        for (std::int32_t const point : small.wall) {
            x[std::size_t(point)] += 0.1 * uniform(random);
            y[std::size_t(point)] += 0.1 * uniform(random);
        }
        bool const any = trial % 2 == 0;
        double const tolerance = any ? std::numeric_limits<double>::infinity() : 0;
        Recovered const elsewhere(solved.basis, x, y, tolerance);
        if (elsewhere.status != HM_OK) continue;
        ++accepted_elsewhere;
        if (elsewhere.rotated_offset > 0) ++turned;
        double const distance =
            distance_of_morph(solved.basis, mesh, elsewhere.move, x, y, small.wall);
        CHECK(distance == doctest::Approx(elsewhere.residual).epsilon(1e-9).scale(1e-4));
        if (!any) CHECK(distance < 1e-3 + elsewhere.rotated_offset);
    }
    CHECK(found_after_morph == 150);
    CHECK(accepted_elsewhere > 75);
    CHECK(turned < 8);
}

TEST_CASE("a wall that is on no curve of the basis is refused with the point and the distance") {
    Case setup = airfoil_case();
    Solved solved(setup.problem(), options_of(HM_CONFORMAL));
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    std::int32_t const wall = points_on(setup.mesh, body)[10];
    y[std::size_t(wall)] += 0.01;
    Recovered const found(solved.basis, x, y);
    CHECK(found.status == HM_BAD_MESH);
    CHECK(std::string(found.error.text).find("the wall is on no curve of this basis") == 0);
    CHECK(found.error.item == wall);
    CHECK(found.error.value > 0.005);
    CHECK(found.error.value < 0.01);
    CHECK(found.move == std::vector<double>(found.move.size(), 7.5));
    CHECK(found.residual == -1);
    CHECK(found.point == -7);
    Recovered const any(solved.basis, x, y, std::numeric_limits<double>::infinity());
    CHECK(any.status == HM_OK);
    CHECK(any.residual == found.error.value);
    CHECK(any.point == wall);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    y[std::size_t(wall)] = nan;
    Recovered const broken(solved.basis, x, y);
    CHECK(broken.status == HM_BAD_MESH);
    CHECK(says(broken.error, "of the wall has a coordinate that is not finite"));
    Recovered const negative(solved.basis, setup.mesh.x, setup.mesh.y, -1);
    CHECK(negative.status == HM_BAD_ARGUMENT);
    CHECK(std::string(negative.error.text).find("tolerance must be at least 0") == 0);
}
