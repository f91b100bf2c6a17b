// Large movements and better cells in one passage of an annulus: what all passages do, and sides
// that stay images.
#include <fixtures/cascade.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/memory.hpp>

using namespace fixtures;

namespace {

double difference_in(Field const& one, Field const& all, std::vector<std::int32_t> const& number) {
    double out = 0;
    for (std::size_t k = 0; k < one.size(); ++k)
        out = std::max(out, std::abs(one[k] - all[std::size_t(number[k])]));
    return out;
}

// The body turned about its middle, and moved.
std::vector<double> turned_and_moved(Case const& setup, double degrees, Complex shift) {
    Complex middle = 0;
    std::size_t const n = setup.curves.control.size() / 2;
    for (std::size_t k = 0; k < n; ++k)
        middle += Complex(setup.curves.control[2 * k], setup.curves.control[2 * k + 1]) / double(n);
    return similarity_move(setup.curves, std::polar(1.0, degrees * pi / 180), middle, shift);
}

hm_improve_report improved(Solved const& solved, Mesh const& mesh, Field const& from, Field& to) {
    Guarded work = block_of(fixtures::improve_size, solved.plan);
    to.resize(from.size());
    hm_points const start = pairs_in(from);
    hm_points_out const better = pairs_out(to);
    auto report = sized<hm_improve_report>();
    REQUIRE(hm_improve(solved.plan, &start, &better, fixtures::Memory(work.data(), work.size()),
                       nullptr, &report, nullptr) == HM_OK);
    CHECK(work.guards_intact());
    CHECK(mesh.x.size() == from.size());
    return report;
}

}  // namespace

TEST_CASE("a safe morph of a passage reaches the target, and the sides and all passages agree") {
    int const n = 6;
    Complex const turn = turn_of_passage(n);
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE, HM_WEIGHTED})
        for (double const degrees : {20.0, 70.0}) {
            INFO("operator " << operator_kind << ", degrees " << degrees);
            Case one = passage(Cells::hybrid, n);
            std::vector<std::vector<std::int32_t>> number;
            Case all = annulus_of(one, n, number);
            std::vector<double> const move = turned_and_moved(one, degrees, {0.02, -0.03});
            Options const options = options_of(operator_kind);
            Safe a(one, options), b(all, options);
            a.run(move);
            CHECK(a.status == HM_OK);
            CHECK(a.is_valid());
            Field const found = positions(a.moved_mesh());
            CHECK(misfit_of_sides(one.mesh, found, turn) < 2e-15);
            CHECK(a.boundary_error(move) < 1e-13);
            // The annulus has real functions without the conformal operator: its bodies go straight
            // on.
            if (operator_kind != HM_CONFORMAL && degrees > 30) continue;
            // Untangling holds the sides, and improvement knows walls by the extent of all of them.
            a.safe_options.skipped_strategies =
                without({HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
            b.safe_options.skipped_strategies = a.safe_options.skipped_strategies;
            a.run(move);
            b.run(turned_copies(move, n));
            CHECK(a.status == b.status);
            CHECK(a.report.resolves == b.report.resolves);
            CHECK(a.report.steps == b.report.steps);
            CHECK(difference_in(positions(a.moved_mesh()), positions(b.moved_mesh()), number[0]) <
                  1e-9);
        }
}

TEST_CASE("given displacements of a passage are safe") {
    int const n = 4;
    Case curved = passage(Cells::hybrid, n);
    Case setup = given_instead(curved);
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        SafeDisplaced safe(setup, options_of(operator_kind));
        Complex const middle = 1.5 * std::polar(1.0, pi / n + 0.2);
        Field const wall = safe.similarity(std::polar(1.0, 1.0), middle, 0.03);
        CHECK_MESSAGE(safe.run(wall) == HM_OK, safe.error.text);  // valid cells are checked here
        CHECK(safe.is_at(wall));
        CHECK(misfit_of_sides(setup.mesh, positions(safe.moved_mesh()), turn_of_passage(n)) <
              1e-15);
    }
}

TEST_CASE("cells of a passage improve as in the annulus of all passages") {
    int const n = 6;
    Complex const turn = turn_of_passage(n);
    for (bool const swapped : {false, true}) {
        Case one = passage(Cells::triangles,
                           n);  // quadrilaterals' targets depend on the extent of all walls
        std::vector<std::vector<std::int32_t>> number;
        Case all = annulus_of(one, n, number);
        if (swapped) {
            one.conditions.pop_back();
            one.set_rotation(right, left);
        }
        Options const options = options_of(HM_CONFORMAL);
        Solved const a(one, &options), b(all, &options);
        std::vector<double> const move = turned_and_moved(one, 25, {0.02, -0.03});
        Field from = displacement(a, move), from_all = displacement(b, turned_copies(move, n));
        Field const start = positions(one.mesh), start_all = positions(all.mesh);
        for (std::size_t k = 0; k < from.size(); ++k) from[k] += start[k];
        for (std::size_t k = 0; k < from_all.size(); ++k) from_all[k] += start_all[k];
        Field better, better_all;
        hm_improve_report const report = improved(a, one.mesh, from, better);
        improved(b, all.mesh, from_all, better_all);
        CHECK(report.min_quality > report.min_quality_before);
        CHECK(report.solutions > 2);
        CHECK(misfit_of_sides(one.mesh, better, turn) < 1e-14);
        std::size_t const side = std::size_t(points_on(one.mesh, left)[4]);
        CHECK(std::abs(better[side] - from[side]) > 1e-4);
        CHECK(difference_in(better, better_all, number[0]) < 1e-6);
    }
}
