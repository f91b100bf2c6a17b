// Validity and quality of polygons as the header defines them, and the movements that keep cells
// valid.
#include "fixtures/memory.hpp"
#include <fixtures/safe.hpp>
#include <doctest/doctest.h>

#include <fixtures/polygons.hpp>

using namespace fixtures;

TEST_CASE("polygons with a coordinate that is not finite count as inverted at any corner") {
    Untrapped const untrapped;
    for (NamedCase& named : polygon_cases()) {
        CAPTURE(named.name);
        Case& setup = named.setup;
        hm_mesh const view = in_polygons(setup.mesh_view());
        Solved const solved(setup.problem(view));
        for (double const bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
            for (std::int32_t point = 0; point < view.n_points; point += 7) {
                std::vector<double> x = setup.mesh.x;
                x[std::size_t(point)] = bad;
                std::int32_t cells = 0;
                for (std::int32_t const corner : setup.mesh.cells) cells += corner == point ? 1 : 0;
                hm_quality_report const seen =
                    quality_of(solved.basis, view, Moved{x, setup.mesh.y});
                CHECK(seen.inverted == cells);
                if (cells > 0) CHECK(seen.min_area == -HUGE_VAL);
            }
        }
    }
}

TEST_CASE("the admissible step of polygons ends where a cell is no longer sound") {
    for (NamedCase& named : polygon_cases()) {
        for (std::int32_t const base : {0, 1}) {
            CAPTURE(named.name);
            Case& setup = named.setup;
            setup.index_base = base;
            Mesh const mesh = counter_clockwise(setup.mesh);
            hm_mesh const view = in_polygons(setup.mesh_view());
            Options options = laplace();
            options.operator_kind = HM_CONFORMAL;
            Solved const solved(setup.problem(view), &options);
            CHECK(is_sound(mesh, mesh.x, mesh.y));
            int stopped = 0;
            for (unsigned seed = 1; seed <= 6; ++seed) {
                std::vector<double> const move = some_move(solved.info().functions, 0.3, seed);
                Moved const by = displaced(solved.basis, move);
                auto assessed = sized<hm_quality_report>();
                hm_step_report const step = step_of(solved.basis, view, by),
                                     also_step = step_of(solved.basis, view, by, &assessed);
                CHECK(also_step.admissible == step.admissible);
                CHECK(also_step.cell == step.cell);
                if (!(step.admissible < 1e6)) continue;
                ++stopped;
                auto const at = [&](double s, std::vector<double>& x, std::vector<double>& y) {
                    x = mesh.x;
                    y = mesh.y;
                    for (std::size_t k = 0; k < x.size(); ++k) {
                        x[k] += s * by.x[k];
                        y[k] += s * by.y[k];
                    }
                };
                std::vector<double> x, y;
                at((1 - 1e-6) * step.admissible, x, y);
                CHECK(is_sound(mesh, x, y));
                CHECK(quality_of(solved.basis, view, Moved{x, y}).inverted == 0);
                at((1 + 1e-6) * step.admissible, x, y);
                hm_quality_report const beyond = quality_of(solved.basis, view, Moved{x, y});
                CHECK(beyond.inverted >= 1);
                CHECK(beyond.first_inverted == step.cell);
                std::vector<std::int32_t> const corners = corners_of(mesh, step.cell - base);
                CHECK(std::count(corners.begin(), corners.end(), step.point - base) == 1);
                at(1, x, y);
                hm_quality_report const measured =
                    quality_of(solved.basis, view, Moved{x, y}, points_in(mesh.x, mesh.y));
                CHECK(measured.inverted == assessed.inverted);
                CHECK(measured.min_quality == doctest::Approx(assessed.min_quality).epsilon(1e-9));
                CHECK(measured.mean_quality ==
                      doctest::Approx(assessed.mean_quality).epsilon(1e-9));
            }
            CHECK(stopped >= 3);
        }
    }
}

TEST_CASE("a convex corner of a polygon may not become reflex, but a flat one may bend") {
    // A regular hexagon inside a ring of quadrilaterals; one corner is pushed inwards.
    Case setup;
    for (int ring_number = 0; ring_number < 3; ++ring_number) {
        for (int k = 0; k < 12; ++k) {  // corners and middles of the sides
            double const flat = k % 2 == 0 ? 1 : std::cos(pi / 6), r = (1 + ring_number) * flat,
                         angle = pi * k / 6;
            setup.mesh.add_point({r * std::cos(angle), r * std::sin(angle)});
        }
    }
    std::vector<std::int32_t>& cells = setup.mesh.cells;
    for (std::int32_t k = 0; k < 12; ++k) cells.push_back(k);
    setup.mesh.cell_start.push_back(12);
    for (std::int32_t j = 0; j < 2; ++j) {
        for (std::int32_t k = 0; k < 12; ++k) {
            std::int32_t const a = 12 * j + k, b = 12 * j + (k + 1) % 12;
            setup.mesh.add_cell({a, a + 12, b + 12, b});
        }
    }
    for (std::int32_t k = 0; k < 12; ++k) setup.mesh.add_face(24 + k, 24 + (k + 1) % 12, far_field);
    setup.curves = ring(2, 12, 3, 3);
    setup.put_on_curves(far_field);
    setup.conditions.clear();
    setup.set_rigid(far_field, 0, 0);
    setup.curves = {};
    hm_mesh const view = in_polygons(setup.mesh_view());
    Solved const solved(setup.problem(view));
    std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
    CHECK(quality_of(solved.basis, view, Moved{x, y}).min_quality > 0.5);
    auto const quality_with = [&](std::size_t point, double part) {
        x = setup.mesh.x;
        y = setup.mesh.y;
        x[point] *= part;
        y[point] *= part;
        return quality_of(solved.basis, view, Moved{x, y});
    };
    // The corner 0 is flat when it lies between its neighbours, at a distance of cos^2(pi / 6) from
    // the centre.
    double const straight = std::pow(std::cos(pi / 6), 2);
    CHECK(quality_with(0, straight + 1e-9).inverted == 0);
    hm_quality_report const reflex = quality_with(0, straight - 1e-9);
    CHECK(reflex.inverted == 1);
    CHECK(reflex.first_inverted == 0);
    CHECK(quality_with(1, 0.9).inverted == 0);  // the middle of a side
    // Bent by 45 degrees towards the inside: the neighbours, at a distance of 1, are half a side
    // away on the side.
    double const bent = (std::cos(pi / 6) - 0.5 * std::tan(pi / 8)) / std::cos(pi / 6);
    CHECK(quality_with(1, bent + 1e-9).inverted == 0);
    CHECK(quality_with(1, bent - 1e-9).inverted == 1);

    // The step is that of the same movement, also if all points have a large displacement in
    // common, because these differences have no rounding.
    double const tick = std::ldexp(1, -20), inwards_x = 0.75,
                 inwards_y = tick * std::round(std::sqrt(0.1875) / tick);
    auto const step_with = [&](double together) {
        std::vector<double> dx(setup.mesh.x.size(), together), dy(dx);
        dx[1] -= inwards_x;
        dy[1] -= inwards_y;
        hm_step_report const step = step_of(solved.basis, view, Moved{dx, dy});
        CHECK(step.cell == 0);
        return step.admissible;
    };
    CHECK(step_with(0) == doctest::Approx(1 - bent).epsilon(1e-5));
    CHECK(step_with(std::ldexp(1, 30)) == doctest::Approx(step_with(0)).epsilon(1e-14));
}

TEST_CASE("polygons: the safe morph and the improvement leave sound cells and say so") {
    for (NamedCase& named : polygon_cases()) {
        if (std::string(named.name) == "clockwise") continue;
        CAPTURE(named.name);
        Case& setup = named.setup;
        hm_mesh const view = in_polygons(setup.mesh_view());
        Options options = options_of(HM_CONFORMAL);
        Solved const solved(setup.problem(view), &options);
        Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
        std::int32_t const n = solved.info().functions;
        std::vector<std::vector<double>> moves = {some_move(n, 0.12, 5), std::vector<double>()};
        moves[1] = turned_by(1.2, setup.curves,
                             std::string(named.name) == "hanging nodes" ? Complex(0.5, 0.5) : 0);
        for (std::vector<double> const& move : moves) {
            for (std::int32_t const skipped :
                 {0, without({HM_STRATEGY_LINEAR, HM_STRATEGY_SUBSTEPS})}) {
                CAPTURE(skipped);
                std::vector<double> x = setup.mesh.x, y = setup.mesh.y;
                auto safe = sized<hm_safe_options>();
                safe.skipped_strategies = skipped;
                auto report = sized<hm_safe_report>();
                hm_error error{};
                REQUIRE(hm_plan_factor(solved.plan, nullptr, nullptr) == HM_OK);
                hm_status const status =
                    safe_move(solved.plan, solved.basis, move.data(), points_out(x, y), nullptr,
                              work.data(), work.size(), &safe, &report, &error);
                INFO(error.text);
                REQUIRE(status >= HM_OK);
                CHECK(work.guards_intact());
                CHECK(report.inverted == 0);
                CHECK(is_sound(setup.mesh, x, y));
                if (skipped == 0) CHECK(report.step_fraction == 1);
                hm_quality_report const measured = quality_of(
                    solved.basis, view, Moved{x, y}, points_in(setup.mesh.x, setup.mesh.y));
                CHECK(measured.min_quality == report.min_quality);
                CHECK(measured.min_quality_cell == report.min_quality_cell);
                CHECK(report.worst[0].cell == report.min_quality_cell);
                CHECK(report.worst[0].quality == report.min_quality);
                CHECK(report.worst[0].cell < setup.mesh.n_cells());

                Guarded improve_work = block_of(fixtures::improve_size, solved.plan);
                auto improved = sized<hm_improve_report>();
                std::vector<double> better_x(x.size()), better_y(x.size());
                REQUIRE(hm_improve(solved.plan, points_in(x, y), points_out(better_x, better_y),
                                   fixtures::Memory(improve_work.data(), improve_work.size()),
                                   nullptr, &improved, &error) == HM_OK);
                CHECK(improve_work.guards_intact());
                CHECK(is_sound(setup.mesh, better_x, better_y));
                CHECK(improved.min_quality_before == measured.min_quality);
                CHECK(improved.mean_quality > 0.97 * improved.mean_quality_before);
            }
        }
        // The mesh itself is as good as it can be: it is its own target.
        std::vector<double> same_x(setup.mesh.x.size()), same_y(same_x);
        auto report = sized<hm_improve_report>();
        Guarded improve_work = block_of(fixtures::improve_size, solved.plan);
        REQUIRE(hm_improve(solved.plan, points_in(setup.mesh.x, setup.mesh.y),
                           points_out(same_x, same_y),
                           fixtures::Memory(improve_work.data(), improve_work.size()), nullptr,
                           &report, nullptr) == HM_OK);
        CHECK(largest_difference(same_x, setup.mesh.x) < 1e-12);
        CHECK(largest_difference(same_y, setup.mesh.y) < 1e-12);
    }
}

TEST_CASE("polygons: the last strategy untangles cells that one step inverts") {
    Case setup = honeycomb_case();
    hm_mesh const view = in_polygons(setup.mesh_view());
    Options options = laplace();
    Solved const solved(setup.problem(view), &options);
    std::vector<double> move;
    Moved to;
    hm_quality_report quality{};
    for (double angle = 0.1; quality.inverted == 0;
         angle *= 1.1) {  // the smallest of these turns that inverts a cell
        REQUIRE(angle < 3);
        move = turned_by(angle, setup.curves, 0);
        to = morphed(solved.basis, setup.mesh, move);
        quality = quality_of(solved.basis, view, to);
    }
    REQUIRE(quality.self_crossing == 0);
    REQUIRE(!is_sound(setup.mesh, to.x, to.y));
    Guarded work = block_of(safe_move_size, solved.plan, solved.basis);
    auto safe = sized<hm_safe_options>();
    safe.max_resolves = -1;
    safe.skipped_strategies = without({HM_STRATEGY_SUBSTEPS});
    auto report = sized<hm_safe_report>();
    REQUIRE(safe_move(solved.plan, solved.basis, move.data(), points_out(to.x, to.y), nullptr,
                      work.data(), work.size(), &safe, &report, nullptr) >= HM_OK);
    CHECK(report.untangled > 0);
    CHECK(is_sound(setup.mesh, to.x, to.y));
}
