// Safe morphs: no inverted cell whatever happens, each strategy where it helps, and the truth about the way.
#include <doctest/doctest.h>

#include <fixtures/c_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/fitted.hpp>
#include <fixtures/safe.hpp>

using namespace fixtures;

namespace {

double const pi = std::acos(-1.0);

// A block of 0.2 x 0.12 in a square of 25 x 25 cells.
Case block(Cells kind = Cells::quads, int n = 25) {
    Case out;
    out.mesh = square(n, kind, 5, 3);
    double const x = 2.5 / n, y = 1.5 / n;
    out.curves = polyline({{0.5 - x, 0.5 - y}, {0.5 + x, 0.5 - y}, {0.5 + x, 0.5 + y}, {0.5 - x, 0.5 + y}});
    out.put_on_curves(body);
    return out;
}

std::vector<double> turn_of(Case const& its, double degrees, Complex shift = 0) {
    return similarity_move(its.curves, std::polar(1.0, degrees * pi / 180), {0.5, 0.5}, shift);
}

}  // namespace

TEST_CASE("the linear strategy: hm_morph's mesh in one step, where that is valid") {
    Case its = block();
    Safe safe(its);
    std::vector<double> const move = turn_of(its, 20);
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.report.strategy == HM_STRATEGY_LINEAR);
    CHECK(safe.report.steps == 1);
    CHECK(safe.report.resolves == 0);
    CHECK(safe.report.step_fraction == 1);
    CHECK(safe.report.other == -1);
    CHECK(safe.report.untangled == 0);
    CHECK(safe.report.admissible == doctest::Approx(safe.admissible(move)));
    CHECK(largest_difference(safe.moved(), displacement(safe.solved(), move)) < 1e-15);
    CHECK(safe.is_valid());
    CHECK(safe.boundary_error(move) < 1e-15);
    REQUIRE(safe.run(std::vector<double>(8, 0.0)) == HM_OK);   // nothing moves
    CHECK(safe.untouched());
    CHECK(safe.report.step_fraction == 1);
    CHECK(safe.is_valid());
}

TEST_CASE("another basis is the one that helps") {
    Case its = block();
    Safe safe(its, options_of(HM_LAPLACE));
    std::vector<double> const move = turn_of(its, 60);
    CHECK(safe.admissible(move) < 1);
    hm_options const weighted = options_of(HM_WEIGHTED, 1), conformal = options_of(HM_CONFORMAL);
    Solved const useless(its, &weighted), useful(its, &conformal);
    const hm_basis* const others[] = {useless.basis, useful.basis};
    safe.safe_options.n_others = 2;
    safe.safe_options.others = others;
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.report.strategy == HM_STRATEGY_OTHER);
    CHECK(safe.report.other == 1);
    CHECK(safe.report.steps == 1);
    CHECK(largest_difference(safe.moved(), displacement(useful, move)) < 1e-15);
    CHECK(safe.is_valid());
    CHECK(safe.boundary_error(move) < 1e-15);
    Attempt real, of;   // a derivative with real values cannot take its complex ones
    hm_options const paper = options_of(HM_LAPLACE), sharper = options_of(HM_CONFORMAL, 8);
    REQUIRE(real.run(its.problem(), &paper));
    CHECK(safe.run(move, real.basis) == HM_SHORT);
    safe.safe_options.n_others = 1;
    CHECK(safe.run(move) == HM_SHORT);   // with the other one alone: as far as one linear step goes
    CHECK(safe.report.step_fraction == doctest::Approx(0.98 * safe.admissible(move)));
    CHECK(safe.report.strategy == HM_STRATEGY_LINEAR);
    CHECK(safe.report.steps == 1);
    CHECK(safe.is_valid());
    safe.safe_options.skipped_strategies |= without({HM_STRATEGY_LINEAR});
    CHECK(safe.run(move) == HM_SHORT);   // nothing else is allowed
    CHECK(safe.untouched());
    CHECK(safe.report.step_fraction == 0);
    CHECK(safe.report.steps == 0);
    safe.safe_options.skipped_strategies |= without({HM_STRATEGY_OTHER});
    safe.safe_options.n_others = 2;
    CHECK(safe.run(move) == HM_SHORT);

    Safe weaker(its, sharper);   // of the same kind: its functions are the derivative
    weaker.safe_options.n_others = 2;
    weaker.safe_options.others = others;
    weaker.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED});
    REQUIRE(of.run(its.problem(), &sharper));
    REQUIRE(weaker.run(move, of.basis) == HM_OK);
    CHECK(weaker.report.strategy == HM_STRATEGY_OTHER);
    CHECK(weaker.report.other == 1);
    std::vector<double> const further = some_move(4, 1, 7);
    CHECK(largest_difference(displacement(of.basis, further), displacement(useful, further)) < 1e-15);
}

TEST_CASE("the longest linear step is straight: no derivative of a path that turns is made of it") {
    Case its = block(Cells::quads, 15);
    hm_options const options = options_of(HM_CONFORMAL);
    Safe safe(its, options);
    Attempt of;
    REQUIRE(of.analyse(its.problem(), &options));
    REQUIRE(of.prepare());
    std::vector<double> const move = turn_of(its, 150, {0.05, 0.02});
    REQUIRE(safe.admissible(move) < 1);
    safe.safe_options.skipped_strategies =
        without({HM_STRATEGY_OTHER, HM_STRATEGY_SUBSTEPS, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
    CHECK(safe.run(move, of.basis) == HM_SHORT);
    CHECK(safe.report.step_fraction == 0);
    CHECK(safe.untouched());
    CHECK(safe.run(move) == HM_SHORT);
    CHECK(safe.report.step_fraction == doctest::Approx(0.98 * safe.admissible(move)));
    CHECK(safe.report.strategy == HM_STRATEGY_LINEAR);
    CHECK(safe.is_valid());
}

TEST_CASE("substeps are what helps: valid, and the wall exactly where its B-spline is") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case its = block(kind);
        Safe safe(its);
        std::vector<double> const move = turn_of(its, 120, {0.02, 0.05});
        CHECK(safe.admissible(move) < 1);
        safe.safe_options.skipped_strategies = without({HM_STRATEGY_OTHER, HM_STRATEGY_UNTANGLED});
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.report.strategy == HM_STRATEGY_SUBSTEPS);
        CHECK(safe.report.step_fraction == 1);
        CHECK(safe.report.steps > 1);
        CHECK(safe.report.resolves == safe.report.steps - 1);
        CHECK(safe.report.resolves <= 10);
        CHECK(safe.is_valid());
        CHECK(safe.boundary_error(move) < 1e-15);
        Field const moved = safe.moved();
        for (std::int32_t const side : {bottom, right, top, left})
            for (std::int32_t const point : points_on(its.mesh, side)) CHECK(moved[static_cast<std::size_t>(point)] == 0.0);
    }
}

TEST_CASE("a substep takes half of what is admissible, on the mesh and with the functions that it begins from") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case its = block(kind);
        Safe safe(its);
        safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_OTHER, HM_STRATEGY_UNTANGLED});
        std::vector<double> const shift = similarity_move(its.curves, 1, {0.5, 0.5}, {0.3, 0.2});
        for (std::vector<double> const& move : {shift, turn_of(its, 150)}) {
            REQUIRE(safe.admissible(move) < 1);
            std::vector<double> x = its.mesh.x, y = its.mesh.y;   // where the substep begins
            for (std::int32_t const resolves : {-1, 1, 2}) {      // -1: none, so that one substep is all there is
                safe.safe_options.max_resolves = resolves;
                REQUIRE(safe.run(move) == HM_SHORT);
                REQUIRE(safe.report.steps == std::max(resolves, 0) + 1);
                std::vector<double> dx(x.size()), dy(x.size());
                for (std::size_t k = 0; k < x.size(); ++k) {
                    dx[k] = safe.x[k] - x[k];
                    dy[k] = safe.y[k] - y[k];
                }
                Mesh from = its.mesh;
                from.x = x;
                from.y = y;
                double const steps = safe.admissible(from.view(), dx, dy);   // like this one, until a cell inverts
                INFO("substep " << safe.report.steps << " to " << safe.report.step_fraction << " of the way");
                CHECK(steps >= 2);
                CHECK(steps < 4);   // and no less than half of that, although a turn's way is bent: trials of it overshoot
                x = safe.x;
                y = safe.y;
            }
        }
        // Straight ahead the displacements are proportional to the way, so that the search ends at half, or just below.
        safe.safe_options.max_resolves = -1;
        REQUIRE(safe.run(shift) == HM_SHORT);
        CHECK(safe.report.step_fraction <= safe.admissible(shift) / 2);
        CHECK(safe.report.step_fraction > 0.98 * safe.admissible(shift) / 2);
    }
}

TEST_CASE("untangling is what helps") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case its = block(kind);
        Safe safe(its);
        std::vector<double> const move = turn_of(its, 100, {0.05, 0.05});
        CHECK(safe.admissible(move) < 1);
        safe.safe_options.skipped_strategies = without({HM_STRATEGY_OTHER, HM_STRATEGY_SUBSTEPS});
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.report.strategy == HM_STRATEGY_UNTANGLED);
        CHECK(safe.report.step_fraction == 1);
        CHECK(safe.report.resolves == 0);
        CHECK(safe.report.untangled > 0);
        CHECK(safe.report.iterations > 0);
        CHECK(safe.is_valid());
        CHECK(safe.boundary_error(move) < 1e-15);
        // Substeps first, as far as they are allowed, then the rest.
        safe.safe_options.skipped_strategies = 0;
        safe.safe_options.max_resolves = -1;
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.report.resolves == 0);
        CHECK(safe.report.step_fraction == 1);
        CHECK(safe.is_valid());
        CHECK(safe.report.strategy == HM_STRATEGY_UNTANGLED);
        CHECK(safe.report.steps == 2);
        CHECK(safe.boundary_error(move) < 1e-15);
    }
}

TEST_CASE("whatever strategy it was: the wall's points have the same bits, rounding does not add up") {
    Case its = block(Cells::quads, 15);
    Safe safe(its);
    std::vector<double> const move = turn_of(its, 115, {0.0123, 0.0321});
    std::vector<double> wall;
    for (std::int32_t const skipped : {without({HM_STRATEGY_UNTANGLED}), without({HM_STRATEGY_SUBSTEPS})}) {
        safe.safe_options.skipped_strategies = skipped;
        REQUIRE(safe.run(move) == HM_OK);
        std::vector<double> found;
        for (std::int32_t const point : points_on(its.mesh, body))
            found.insert(found.end(), {safe.x[static_cast<std::size_t>(point)], safe.y[static_cast<std::size_t>(point)]});
        if (!wall.empty()) CHECK(same_bits(found, wall));
        wall = found;
    }
}

TEST_CASE("slipping points stay on their lines and periodic sides move alike, in substeps and in untangling") {
    Case slip = block(Cells::hybrid, 15), pair = block(Cells::hybrid, 15);
    for (std::int32_t const side : {bottom, right, top, left}) slip.set_slip(side);
    pair.set_periodic(left, right);
    for (std::int32_t const skipped : {without({HM_STRATEGY_UNTANGLED}), without({HM_STRATEGY_SUBSTEPS})}) {
        Safe sliding(slip), alike(pair);
        sliding.safe_options.skipped_strategies = alike.safe_options.skipped_strategies = skipped;
        REQUIRE(sliding.run(turn_of(slip, 120, {0.1, 0.02})) == HM_OK);
        REQUIRE(sliding.report.strategy != HM_STRATEGY_LINEAR);
        double slid = 0;
        for (std::int32_t const point : points_on(slip.mesh, bottom)) {
            CHECK(sliding.y[static_cast<std::size_t>(point)] == 0);
            slid = std::fmax(slid, std::fabs(sliding.moved()[static_cast<std::size_t>(point)].real()));
        }
        CHECK(slid > 1e-3);
        REQUIRE(alike.run(turn_of(pair, 110, {0.1, 0.05})) == HM_OK);
        REQUIRE(alike.report.strategy != HM_STRATEGY_LINEAR);
        std::vector<std::int32_t> const l = points_on(pair.mesh, left), r = points_on(pair.mesh, right);
        Field const moved = alike.moved();
        for (std::size_t j = 0; j < l.size(); ++j)
            CHECK(std::abs(moved[static_cast<std::size_t>(l[j])] - moved[static_cast<std::size_t>(r[j])]) < 1e-15);
    }
}

TEST_CASE("sliding points that would pass each other in one step are no crossing: in several they do not") {
    Case its;
    its.mesh = square(25, Cells::quads, 5, 1);
    its.curves = polyline({{0.4, 0.48}, {0.6, 0.48}, {0.6, 0.52}, {0.4, 0.52}});
    its.put_on_curves(body);
    for (std::int32_t const side : {bottom, right, top, left}) its.set_slip(side);
    Safe safe(its);   // conformal, 1 / d^1.5
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(turn_of(its, 60, {-0.2, -0.3})) == HM_OK);
    CHECK(safe.report.step_fraction == 1);
    CHECK(safe.report.strategy == HM_STRATEGY_SUBSTEPS);
    CHECK(safe.is_valid());
}

TEST_CASE("heights of the first layer: limited where that is asked for, a warning with the place where it cannot be had") {
    Case its;
    its.mesh = o_mesh(naca4({}, 40), stretched(1e-3, 8, 24));
    its.curves.add(fitted_loop(points_along(its.mesh, body), 16));
    its.put_on_curves(body);
    Safe safe(its);
    std::vector<double> move(its.curves.control.size());
    for (std::size_t k = 0; k < move.size(); k += 2) {
        double const x = its.curves.control[k];
        move[k + 1] = 0.4 * x * (1 - x);   // a camber of .1
    }
    REQUIRE(safe.run(move) == HM_OK);
    double const low = safe.report.min_height_ratio, high = safe.report.max_height_ratio;
    double const change = std::max(high, 1 / low);
    CHECK(safe.report.heights == 0);
    REQUIRE(change > 1.1);   // conformal functions stretch heights with the wall
    // What is met anyway changes nothing.
    std::vector<double> const x = safe.x, y = safe.y;
    safe.safe_options.max_height_change = 1.01 * change;
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(same_bits(safe.x, x));
    CHECK(same_bits(safe.y, y));
    // Half of the change: heights are brought back.
    safe.safe_options.max_height_change = 1 + 0.5 * (change - 1);
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.is_valid());
    CHECK(safe.report.max_height_ratio <= safe.safe_options.max_height_change);
    CHECK(safe.report.min_height_ratio >= 1 / safe.safe_options.max_height_change);
    // Heights come back but for rounding; less is too much to ask for, and said.
    safe.safe_options.max_height_change = 1 + 1e-9;
    CHECK(safe.run(move) == HM_OK);
    safe.safe_options.max_height_change = std::nextafter(1.0, 2.0);
    CHECK(safe.run(move) == HM_POOR);
    CHECK(safe.is_valid());
    CHECK(std::string(safe.error.text).find("the height of the first layer at point") != std::string::npos);
    CHECK(safe.report.max_height_ratio < high);
    std::vector<std::int32_t> const wall = points_on(its.mesh, body);
    CHECK(std::find(wall.begin(), wall.end(), safe.error.item) != wall.end());
}

TEST_CASE("short of the target: the last valid mesh is that fraction of the way along") {
    Case its = block();
    Safe safe(its);
    std::vector<double> const move = turn_of(its, 150);
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
    CHECK(safe.report.cell < its.mesh.n_cells());
    CHECK(safe.error.item == safe.report.cell);
    CHECK(safe.is_valid());
    CHECK(safe.boundary_error(turn_of(its, 150 * t)) < 1e-11);   // a turn is a turn all the way
    CHECK(safe.boundary_error(reached) < 1e-15);
    for (int const resolves : {-1, 2, 4}) {   // the more is allowed, the farther
        double const before = resolves < 0 ? 0 : t;
        safe.safe_options.max_resolves = resolves;
        hm_status const status = safe.run(move);
        CHECK((status == HM_SHORT || status == HM_OK));
        CHECK(safe.report.step_fraction > before);
        CHECK((resolves > 0 || safe.report.step_fraction < t));
        CHECK(safe.is_valid());
    }
}

TEST_CASE("a boundary that crosses itself is refused at once, with the place, and nothing is written") {
    Case its = block();
    Safe safe(its);
    std::vector<double> move(8, 0.0);
    move[0] = 0.3;   // the lower left corner behind the lower right one, and up
    move[1] = 0.06;
    Attempt derivative;
    hm_options const options = options_of(HM_CONFORMAL);
    REQUIRE(derivative.run(its.problem(), &options));
    CHECK(safe.run(move, derivative.basis) == HM_CROSSING);
    CHECK(safe.untouched());
    CHECK(safe.report.crossing_points[0] >= 0);
    CHECK(safe.report.crossing_points[2] >= 0);
    CHECK(safe.report.steps == 0);
    std::vector<std::int32_t> const on_body = points_on(its.mesh, body);
    for (std::int32_t const point : safe.report.crossing_points)
        CHECK(std::find(on_body.begin(), on_body.end(), point) != on_body.end());
    CHECK(safe.error.item == safe.report.crossing_points[0]);
    CHECK(safe.run(turn_of(its, 0, {0.45, 0.013})) == HM_CROSSING);   // through the side of the square
    CHECK(safe.untouched());
    hm_basis_info info{};
    info.struct_size = sizeof info;
    REQUIRE(hm_basis_info_get(derivative.basis, &info, nullptr) == HM_OK);
    CHECK(info.solved == 1);   // refused: as it was
}

TEST_CASE("a thousand random movements of growing size: valid, or refused with a reason; never an inverted cell") {
    struct Start {
        Case its;
        std::int32_t operator_kind;
    };
    Case tiny = tiny_case(), bodies = two_body_case(Cells::hybrid, 4, 3), channel = tiny_case();
    for (std::int32_t const side : {bottom, right, top, left}) channel.set_slip(side);
    bodies.conditions.pop_back();
    bodies.set_rigid(second_body, 1.5, 0.5);
    Case cascade = tiny_case();
    cascade.set_periodic(left, right);
    Start starts[] = {{tiny, HM_CONFORMAL}, {tiny, HM_LAPLACE}, {bodies, HM_CONFORMAL}, {channel, HM_CONFORMAL},
                      {cascade, HM_CONFORMAL}};
    for (Start& start : starts) {
        Safe safe(start.its, options_of(start.operator_kind));
        std::int32_t const n = safe.solved().info().functions;
        double const size = start.its.curves.n_control() == 4 ? 4 : 0.5;
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
            CHECK(std::fabs(safe.boundary_error(move) - safe.report.turned_offset) < 1e-14);
        }
        CHECK(reached > 10);
        CHECK(refused > 5);
        CHECK(by_strategy[HM_STRATEGY_LINEAR] > 0);
        CHECK(by_strategy[HM_STRATEGY_SUBSTEPS] > 0);
        CHECK(by_strategy[HM_STRATEGY_UNTANGLED] > 0);
    }
}

TEST_CASE("an airfoil in a C-mesh, moved, turned and bent at random: the two sides of the wake stay one") {
    CMesh const c = c_mesh(naca4({}, 24), 12, 8, stretched(5e-3, 8, 12));
    Case its = airfoil_case(24, 12);
    its.mesh = c.mesh;
    Safe safe(its);
    int by_strategy[4] = {};
    for (unsigned trial = 0; trial < 60; ++trial) {
        std::vector<double> move = similarity_move(its.curves, std::polar(1.0, 0.05 * trial), {0.25, 0}, {0.01 * trial, 0});
        std::vector<double> const more = some_move(12, 0.0005 * trial, 200 + trial);
        for (std::size_t k = 0; k < move.size(); ++k) move[k] += more[k];
        hm_status const status = safe.run(move);
        REQUIRE((status == HM_OK || status == HM_SHORT || status == HM_CROSSING));
        if (status == HM_CROSSING) continue;
        CHECK(safe.is_valid());
        if (status == HM_OK) CHECK(std::fabs(safe.boundary_error(move) - safe.report.turned_offset) < 1e-14);
        ++by_strategy[safe.report.strategy];
        Mesh const& mesh = safe.mesh;
        std::map<std::pair<double, double>, std::size_t> first;   // points at one place stay at one place
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {
            std::size_t const its_first = first.insert({{mesh.x[k], mesh.y[k]}, k}).first->second;
            CHECK(safe.x[k] == safe.x[its_first]);
            CHECK(safe.y[k] == safe.y[its_first]);
        }
    }
    CHECK(by_strategy[HM_STRATEGY_LINEAR] > 10);
    CHECK(by_strategy[HM_STRATEGY_SUBSTEPS] + by_strategy[HM_STRATEGY_UNTANGLED] > 3);
}

TEST_CASE("numbering from 1, cells of either sense, and units change nothing but numbers") {
    Case its = block(Cells::hybrid, 15);
    std::vector<double> const move = turn_of(its, 150);
    Safe reference(its);
    for (std::int32_t const skipped : {without({HM_STRATEGY_UNTANGLED}), 0}) {
        reference.safe_options.skipped_strategies = skipped;
        reference.safe_options.max_resolves = 2;
        hm_status const expected = reference.run(move);
        CHECK(expected == (skipped != 0 ? HM_SHORT : HM_OK));
        Case from_one = its;
        from_one.index_base = 1;
        reverse_some(from_one.mesh, 3);
        Safe other(from_one);
        other.safe_options = reference.safe_options;
        CHECK(other.run(move) == expected);
        CHECK(other.report.strategy == reference.report.strategy);
        CHECK(other.report.step_fraction == doctest::Approx(reference.report.step_fraction).epsilon(1e-9));
        CHECK(largest_difference(other.moved(), reference.moved()) < 1e-8);
        if (expected == HM_SHORT) {
            CHECK(other.report.cell == reference.report.cell + 1);
            CHECK(other.report.point == reference.report.point + 1);
            CHECK(other.error.item == other.report.cell);
        }
        CHECK(other.report.min_quality_cell == reference.report.min_quality_cell + 1);
        for (double const unit : {1e-9, 1e20}) {
            Case scaled = similar(its, unit, 0);
            std::vector<double> scaled_move = move;
            for (double& m : scaled_move) m *= unit;
            Safe far(scaled);
            far.safe_options = reference.safe_options;
            CHECK(far.run(scaled_move) == expected);
            CHECK(far.report.strategy == reference.report.strategy);
            CHECK(far.report.steps == reference.report.steps);
            CHECK(far.report.step_fraction == doctest::Approx(reference.report.step_fraction).epsilon(1e-6));
            CHECK(far.is_valid());
            CHECK(far.report.min_quality == doctest::Approx(reference.report.min_quality).epsilon(1e-3));
        }
    }
}

TEST_CASE("functions on the way that miss the tolerance are a warning: the mesh is there, and valid") {
    Case its = block(Cells::quads, 15);
    hm_options options = options_of(HM_CONFORMAL);
    options.tolerance = 1e-18;
    Attempt const attempt(its.problem(), &options);
    REQUIRE(attempt.status == HM_NOT_CONVERGED);
    std::size_t bytes = 0;
    REQUIRE(hm_morph_safe_size(attempt.plan, attempt.basis, &bytes, nullptr) == HM_OK);
    Guarded work(bytes);
    hm_safe_report report{};
    report.struct_size = sizeof report;
    std::vector<double> x(its.mesh.x.size()), y(x.size());
    hm_error error{};
    CHECK(hm_morph_safe(attempt.plan, attempt.basis, turn_of(its, 120).data(), points_out(x, y), nullptr, work.data(),
                        bytes, nullptr, &report, &error) == HM_NOT_CONVERGED);
    CHECK(report.step_fraction == 1);
    CHECK(report.resolves > 0);
    CHECK(report.inverted == 0);
    CHECK(x[0] == its.mesh.x[0]);
    CHECK(error.value > 1e-18);
    // One step needs no other functions than those that are there.
    CHECK(hm_morph_safe(attempt.plan, attempt.basis, turn_of(its, 10).data(), points_out(x, y), nullptr, work.data(),
                        bytes, nullptr, &report, &error) == HM_OK);
}

TEST_CASE("cancelled by the progress callback: nothing is written, and afterwards it works again") {
    struct Listener {
        int calls = 0, stop_at = 1 << 30;
        static std::int32_t call(void* user, std::int32_t, double) {
            Listener& self = *static_cast<Listener*>(user);
            return self.calls++ >= self.stop_at ? 1 : 0;
        }
    };
    Case its = block(Cells::quads, 15);
    Listener listener;
    hm_options options = options_of(HM_CONFORMAL);
    options.progress = Listener::call;
    options.progress_user = &listener;
    Safe safe(its, options);
    std::vector<double> const move = turn_of(its, 120);
    listener.calls = 0;
    REQUIRE(safe.run(move) == HM_OK);
    REQUIRE(safe.report.resolves > 0);
    int const all = listener.calls;
    std::vector<double> const expected = safe.x;
    CHECK(all > 4);
    for (int stop = 0; stop < all; stop += 1 + all / 20) {
        listener.calls = 0;
        listener.stop_at = stop;
        CHECK(safe.run(move) == HM_CANCELLED);
        CHECK(safe.untouched());
    }
    listener.stop_at = 1 << 30;
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(same_bits(safe.x, expected));
}

TEST_CASE("working space: exactly the stated size, and refused at every size below") {
    Case its = tiny_case();
    Safe safe(its);
    std::vector<double> const move = turn_of(its, 20);
    std::size_t const bytes = safe.work().size();
    std::vector<double> x = its.mesh.x, y = its.mesh.y;
    for (std::size_t give = 0; give < bytes; give += give + 300 < bytes ? 251 : 1) {
        Guarded less(give);
        hm_error error{};
        hm_status const status = hm_morph_safe(safe.solved().plan, safe.solved().basis, move.data(), points_out(x, y),
                                               nullptr, less.data(), give, nullptr, nullptr, &error);
        if (status == HM_OK) CHECK(bytes - give < 64);   // the slack for alignment
        else {
            REQUIRE(status == HM_BLOCK_TOO_SMALL);
            CHECK(error.value > 0);
            CHECK(error.value <= static_cast<double>(bytes - give));
        }
        CHECK(less.guards_intact());
        if (status == HM_OK) break;
    }
    for (std::size_t const shift : {std::size_t{1}, std::size_t{33}}) {
        Guarded other(bytes, shift);
        CHECK(hm_morph_safe(safe.solved().plan, safe.solved().basis, move.data(), points_out(x, y), nullptr,
                            other.data(), bytes, nullptr, nullptr, nullptr) >= HM_OK);
        CHECK(other.guards_intact());
    }
}

TEST_CASE("the derivative: exact at wall points on their curve, the steps' sum elsewhere; hm_adjoint is its transpose") {
    for (bool const slip : {false, true})
        for (bool const untangled : {false, true}) {
            Case its = block(Cells::quads, 15);
            if (slip)
                for (std::int32_t const side : {bottom, right, top, left}) its.set_slip(side);
            hm_options const options = options_of(HM_CONFORMAL);
            Safe safe(its, options);
            Attempt of;
            REQUIRE(of.analyse(its.problem(), &options));
            REQUIRE(of.prepare());
            std::vector<double> const move = turn_of(its, 120, {slip ? 0.1 : 0.05, 0.02});
            if (untangled) safe.safe_options.skipped_strategies = without({HM_STRATEGY_SUBSTEPS});
            REQUIRE(safe.run(move, of.basis) == HM_OK);
            CHECK(of.guards_intact());
            CHECK(safe.report.strategy == (untangled ? HM_STRATEGY_UNTANGLED : HM_STRATEGY_SUBSTEPS));
            std::vector<double> const further = some_move(4, 1, 3);
            Field const by = displacement(of.basis, further), of_wall = displacement(safe.solved(), further);
            for (std::int32_t const point : points_on(its.mesh, body))
                CHECK(std::abs(by[static_cast<std::size_t>(point)] - of_wall[static_cast<std::size_t>(point)]) < 1e-13);
            for (std::int32_t const point : points_on(its.mesh, bottom)) {
                Complex const d = by[static_cast<std::size_t>(point)];
                CHECK((slip ? d.imag() == 0 : d == 0.0));
            }
            std::vector<double> const g = some_move(its.mesh.n_points(), 1, 4);
            std::vector<double> gradient(8);
            REQUIRE(hm_adjoint(of.basis, points_in(g.data(), g.data() + 1, 2), gradient.data(), nullptr, nullptr) ==
                    HM_OK);
            double here = 0, there = 0;
            for (std::size_t k = 0; k < by.size(); ++k) here += g[2 * k] * by[k].real() + g[2 * k + 1] * by[k].imag();
            for (std::size_t k = 0; k < 8; ++k) there += gradient[k] * further[k];
            CHECK(here == doctest::Approx(there).epsilon(1e-11));
            // It is a basis as any other: whole, solved, of this mesh.
            hm_mesh const mesh = its.mesh.view();
            hm_basis_info info{};
            info.struct_size = sizeof info;
            REQUIRE(hm_basis_info_get(of.basis, &info, nullptr) == HM_OK);
            const hm_basis* attached = nullptr;
            CHECK(hm_basis_attach(&attached, of.basis, static_cast<std::size_t>(info.bytes), &mesh, nullptr) == HM_OK);
        }
}

TEST_CASE("in one step the derivative is the basis; with real functions and straight ways, the mean of the steps'") {
    Case its = block(Cells::quads, 15);
    for (std::int32_t const operator_kind : {HM_CONFORMAL, HM_LAPLACE}) {
        hm_options const options = options_of(operator_kind);
        Safe safe(its, options);
        Attempt of;
        REQUIRE(of.analyse(its.problem(), &options));
        REQUIRE(of.prepare());
        REQUIRE(safe.run(turn_of(its, 1), of.basis) == HM_OK);
        REQUIRE(safe.report.strategy == HM_STRATEGY_LINEAR);
        std::vector<double> const further = some_move(4, 1, 5);
        CHECK(largest_difference(displacement(of.basis, further), displacement(safe.solved(), further)) < 1e-15);
    }
    // Straight ways and frozen functions: x_new = x + sum over the steps of (t_k - t_(k-1)) F_k dP is linear in dP, so that
    // the derivative by dP, applied to dP itself, is all that the mesh has moved.
    Safe safe(its, options_of(HM_LAPLACE));
    hm_options const options = options_of(HM_LAPLACE);
    Attempt of;
    REQUIRE(of.analyse(its.problem(), &options));
    REQUIRE(of.prepare());
    std::vector<double> const move = turn_of(its, 35, {0.1, 0.05});
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(move, of.basis) >= 0);
    REQUIRE(safe.report.steps > 2);
    if (safe.status == HM_OK) CHECK(largest_difference(displacement(of.basis, move), safe.moved()) < 1e-12);
}

TEST_CASE("the derivative is the sum of the steps' functions, each times what its movement changes by with the whole") {
    Case its = block(Cells::quads, 15);
    hm_options const options = options_of(HM_CONFORMAL);
    Safe safe(its, options);
    Attempt of;
    REQUIRE(of.analyse(its.problem(), &options));
    REQUIRE(of.prepare());
    double const degrees = 120;
    std::vector<double> const move = turn_of(its, degrees), further = some_move(4, 1, 6);
    safe.safe_options.skipped_strategies = without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
    REQUIRE(safe.run(move, of.basis) == HM_OK);
    std::int32_t const steps = safe.report.steps;
    REQUIRE(steps > 2);
    // The way of a turn by the angle a is P(t) = c + r^t (P + t D), r = e^(i a), D = (P + dP - c) / r - P + c, and so
    // dP(t) / d(dP) = t r^(t - 1) while r is held.
    auto const weight = [&](double t) { return t * std::polar(1.0, (t - 1) * degrees * pi / 180); };
    Field const found = displacement(of.basis, further);
    Field expected(found.size(), 0);
    double from = 0;
    std::vector<double> x = its.mesh.x, y = its.mesh.y;
    for (std::int32_t step = 1; step <= steps; ++step) {
        Attempt here;   // the functions of this step, on the mesh it began with
        REQUIRE(here.analyse(its.problem(), &options));
        REQUIRE(here.prepare());
        REQUIRE(hm_plan_factor(here.plan, points_in(x, y), nullptr) == HM_OK);
        REQUIRE(hm_plan_solve(here.plan, here.basis, nullptr, nullptr) == HM_OK);
        safe.safe_options.max_resolves = step == 1 ? -1 : step - 1;   // the way as far as that
        Attempt unused;   // with a derivative as before: without one, other paths are tried, too
        REQUIRE(unused.analyse(its.problem(), &options));
        REQUIRE(unused.prepare());
        REQUIRE(safe.run(move, unused.basis) == (step < steps ? HM_SHORT : HM_OK));
        REQUIRE(safe.report.steps == step);
        double const to = safe.report.step_fraction;
        Field const part = displacement(here.basis, turned(further, weight(to) - weight(from)));
        for (std::size_t k = 0; k < part.size(); ++k) expected[k] += part[k];
        from = to;
        x = safe.x;
        y = safe.y;
    }
    CHECK(from == 1);
    CHECK(largest_difference(found, expected) < 1e-10);
}

TEST_CASE("the same bits for any number of threads, in place, and on another array") {
    Case its = block();
    std::vector<double> const move = turn_of(its, 110, {0.03, 0});
    for (std::int32_t const skipped : {0, without({HM_STRATEGY_SUBSTEPS})}) {
        Safe serial(its);
        serial.safe_options.skipped_strategies = skipped;
        REQUIRE(serial.run(move) == HM_OK);
        for (std::int32_t const threads : {2, 5}) {
            Backwards backwards;
            hm_executor const executor = backwards.executor(threads);
            hm_options options = options_of(HM_CONFORMAL);
            options.executor = &executor;
            Safe safe(its, options);
            safe.safe_options.skipped_strategies = skipped;
            REQUIRE(safe.run(move) == HM_OK);
            CHECK(same_bits(safe.x, serial.x));
            CHECK(same_bits(safe.y, serial.y));
            CHECK(safe.report.min_quality == serial.report.min_quality);
        }
    }
    hm_options const options = options_of(HM_CONFORMAL);
    Safe reference(its);
    REQUIRE(reference.run(move) == HM_OK);
    Case own = its;
    hm_mesh view = own.mesh.view();
    hm_problem const problem = own.problem(view);
    Solved const solved(problem, &options);
    std::size_t bytes = 0;
    REQUIRE(hm_morph_safe_size(solved.plan, solved.basis, &bytes, nullptr) == HM_OK);
    Guarded work(bytes);
    REQUIRE(hm_morph_safe(solved.plan, solved.basis, move.data(), points_out(own.mesh.x, own.mesh.y), nullptr,
                          work.data(), bytes, nullptr, nullptr, nullptr) == HM_OK);
    CHECK(same_bits(own.mesh.x, reference.x));
    CHECK(same_bits(own.mesh.y, reference.y));
}

TEST_CASE("what does not belong together is refused, and nothing is written") {
    Case its = tiny_case();
    Safe safe(its);
    std::vector<double> const move = turn_of(its, 10);
    auto const refused = [&](hm_plan* plan, const hm_basis* basis, std::vector<double> const& by,
                             hm_basis* derivative = nullptr) {
        std::size_t bytes = 0;
        REQUIRE(hm_morph_safe_size(plan, nullptr, &bytes, nullptr) == HM_OK);
        Guarded work(bytes);
        std::vector<double> x = its.mesh.x, y = its.mesh.y;
        hm_status const status = hm_morph_safe(plan, basis, by.data(), points_out(x, y), derivative, work.data(), bytes,
                                               &safe.safe_options, nullptr, nullptr);
        CHECK(same_bits(x, its.mesh.x));
        CHECK(same_bits(y, its.mesh.y));
        return status;
    };
    hm_options const conformal = options_of(HM_CONFORMAL), sharper = options_of(HM_CONFORMAL, 8);
    hm_options const paper = options_of(HM_LAPLACE);
    Solved const other_exponent(its, &sharper), other_operator(its, &paper);
    Case elsewhere = its;
    elsewhere.give(17, 0.4);
    Solved const other_parameters(elsewhere, &conformal);
    hm_plan* const plan = safe.solved().plan;
    CHECK(refused(plan, other_exponent.basis, move) == HM_BAD_BASIS);
    CHECK(refused(plan, other_operator.basis, move) == HM_BAD_BASIS);
    CHECK(refused(plan, other_parameters.basis, move) == HM_BAD_BASIS);
    CHECK(refused(plan, safe.solved().basis, move, other_operator.basis) == HM_BAD_BASIS);
    Attempt unsolved;
    REQUIRE(unsolved.analyse(its.problem(), &conformal));
    REQUIRE(unsolved.prepare());
    CHECK(refused(unsolved.plan, unsolved.basis, move) == HM_BAD_BASIS);
    std::vector<double> wrong = move;
    wrong[3] = std::nan("");
    CHECK(refused(plan, safe.solved().basis, wrong) == HM_BAD_ARGUMENT);
    // Among the others: another operator and exponent are welcome, other curves and parameters, and unsolved ones, are not.
    const hm_basis* others[] = {other_exponent.basis, other_operator.basis, nullptr};
    safe.safe_options.n_others = 2;
    safe.safe_options.others = others;
    CHECK(safe.run(move) == HM_OK);
    safe.safe_options.n_others = 3;
    CHECK(refused(plan, safe.solved().basis, move) == HM_BAD_ARGUMENT);
    others[2] = other_parameters.basis;
    CHECK(refused(plan, safe.solved().basis, move) == HM_BAD_BASIS);
    others[2] = unsolved.basis;
    CHECK(refused(plan, safe.solved().basis, move) == HM_BAD_BASIS);
    Case knots = its;   // the same points and parameters on a curve of another shape
    knots.curves.shapes[0].knots[2] += 0.01;
    knots.give(17, 0.5);
    Case knots_before = its;
    knots_before.give(17, 0.5);
    Solved const other_knots(knots, &conformal);
    others[2] = other_knots.basis;
    CHECK(refused(plan, safe.solved().basis, move) == HM_BAD_BASIS);
    for (std::int32_t const n : {-1, 65}) {
        safe.safe_options.n_others = n;
        CHECK(refused(plan, safe.solved().basis, move) == HM_BAD_ARGUMENT);
    }
}
