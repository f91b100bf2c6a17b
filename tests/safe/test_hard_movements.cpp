// Movements that are possible, on meshes with traits that have made them look impossible; and
// impossible ones.
#include "measure/deform/seeds.hpp"

#include <fixtures/channels.hpp>
#include <fixtures/safe.hpp>
#include <fixtures/fitted.hpp>

using namespace fixtures;

namespace {

// Smooth and random; 0 at both ends of an open curve, or periodic.
std::vector<double> smooth_move(std::int32_t n, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> move(2 * std::size_t(n), 0.0);
    for (int wave = 1; wave <= 4; ++wave)
        for (std::size_t side = 0; side < 2; ++side) {
            double const amount = size * (2 * uniform(random) - 1) / wave * (side == 0 ? 0.2 : 1);
            for (std::size_t k = 0; k < std::size_t(n); ++k)
                move[2 * k + side] += amount * std::sin(pi * wave * double(k) / (n - 1));
        }
    move[move.size() - 2] = move[move.size() - 1] = 0;  // and not the rounding of a sine
    return move;
}

}  // namespace

TEST_CASE("the ends of a piece of a channel's floor stay where they are on the way") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = channel(20, 24, 1e-5, 40, kind);
        Safe safe(setup);
        safe.safe_options.min_quality = 0;
        std::int32_t const corners[] = {points_on(setup.mesh, body).front(),
                                        points_on(setup.mesh, body).back()};
        for (unsigned const seed : {1u, 2u, 3u, 4u}) {
            INFO("seed " << seed << ": " << safe.report.step_fraction << ", " << safe.error.text);
            std::vector<double> const move = smooth_move(40, 0.6, seed);
            CHECK(safe.admissible(move) < 1);  // one step does not do
            REQUIRE(safe.run(move) >= HM_OK);
            CHECK(safe.report.step_fraction == 1);
            CHECK(safe.is_valid());
            CHECK(safe.boundary_error(move) < 1e-14);
            // Without further solutions the morph makes one step, and both ends are where they
            // were, to the bit.
            safe.safe_options.max_resolves = -1;
            safe.safe_options.skipped_strategies =
                without({HM_STRATEGY_LINEAR, HM_STRATEGY_UNTANGLED});
            REQUIRE(safe.run(move) == HM_SHORT);
            CHECK(safe.report.steps == 1);
            for (std::int32_t const k : corners) {
                CHECK(safe.x[std::size_t(k)] == setup.mesh.x[std::size_t(k)]);
                CHECK(safe.y[std::size_t(k)] == setup.mesh.y[std::size_t(k)]);
            }
            safe.safe_options.max_resolves = 0;
            safe.safe_options.skipped_strategies = 0;
        }
    }
}

TEST_CASE("the wall of a nozzle moves from corner to corner while its axis slips") {
    Case setup = nozzle(40, 20, 1e-4, 16);
    Safe safe(setup);
    safe.safe_options.min_quality = 0;
    std::vector<double> move(32, 0.0);
    for (std::size_t k = 0; k < 16; ++k) {
        double const x = setup.curves.control[2 * k] / 2;
        move[2 * k + 1] = -0.3 * std::pow(std::sin(pi * x), 2) + 0.08 * std::sin(2 * pi * x);
    }
    CHECK(safe.admissible(move) < 1);
    REQUIRE(safe.run(move) == HM_OK);
    CHECK(safe.is_valid());
    CHECK(safe.report.min_quality > 0.2);
    CHECK(safe.report.resolves <= 6);
    for (std::int32_t const k : points_on(setup.mesh, bottom)) CHECK(safe.y[std::size_t(k)] == 0);
    for (std::size_t k = 1; k < 32; k += 2) move[k] *= 2;  // the throat below the axis
    CHECK(safe.run(move) == HM_CROSSING);
    CHECK(safe.untouched());
}

TEST_CASE("slat, main element and flap turn by 20, -20 and 10 degrees") {
    Case setup = three_elements();
    std::vector<double> const move = turn_each(setup.curves, {20, -20, 10});
    for (std::int32_t const kind : {HM_CONFORMAL, HM_LAPLACE}) {
        Safe safe(setup, options_of(kind));
        CHECK(safe.admissible(move) < 0.5);
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.is_valid());
        CHECK(std::fabs(safe.boundary_error(move) - safe.report.rotated_offset) < 1e-14);
    }
}

TEST_CASE("the sides of a periodic cascade follow translations by half a chord and half a pitch") {
    for (Cells const kind : {Cells::quads, Cells::triangles})
        for (Complex const shift : {Complex(0.15, 0), Complex(0, 0.5), Complex(-0.15, -0.5)}) {
            Case setup = plate_cascade(8, kind);
            Safe safe(setup);
            safe.safe_options.min_quality = 0;
            std::vector<double> const move = similarity_move(setup.curves, 1, 0, shift);
            REQUIRE(safe.run(move) == HM_OK);
            CHECK(safe.is_valid());
            CHECK(safe.report.resolves <= 6);
            CHECK(safe.boundary_error(move) < 1e-15);
        }
}

// Every movement that crosses no wall ends at the target, with the quality asked for and six
// solutions at most.
TEST_CASE("random movements of half a channel's floor and of a cascade by half a pitch are safe") {
    Case floor = channel(14, 16, 0.004, 20), row;
    row.mesh = cascade_mesh();
    row.curves.add(fitted_loop(points_along(row.mesh, CascadeMarkers::blade), 20));
    row.put_on_curves(CascadeMarkers::blade);
    row.set_periodic(CascadeMarkers::lower, CascadeMarkers::upper);
    for (bool const is_row : {false, true}) {
        Safe safe(is_row ? row : floor);
        safe.safe_options.min_quality = 0;
        int counted = 0;
        for (std::uint64_t seed = 1; seed <= 11; ++seed) {
            std::vector<double> const move =
                is_row ? deform::random_flight(row.curves.control, seed, 0.45)
                       : deform::random_bump(20, seed, 0.5);
            hm_status const status = safe.run(move);
            if (status == HM_CROSSING) continue;
            INFO((is_row ? "cascade" : "channel") << ", seed " << seed << ": " << safe.error.text);
            ++counted;
            CHECK(status == HM_OK);
            CHECK(safe.is_valid());
            CHECK(safe.report.resolves <= 6);
            CHECK(safe.report.min_quality >= 0.05 * safe.report.start_quality);
        }
        CHECK(counted >= 7);
    }
}

// Good cells may be found far below the step at which the first cell inverts.
TEST_CASE("one linear step goes as far as cells are good, however short, and the reason is told") {
    Case setup = airfoil_case();
    Safe safe(setup, options_of(HM_LAPLACE));
    safe.safe_options.max_resolves = -1;
    safe.safe_options.skipped_strategies =
        without({HM_STRATEGY_OTHER, HM_STRATEGY_UNTANGLED, HM_STRATEGY_IMPROVED});
    std::vector<double> const move =
        similarity_move(setup.curves, std::polar(1.0, 60 * pi / 180), 0.25);
    double last = 1;
    for (double const wanted : {0.5, 0.9, 0.99, 0.9999}) {
        safe.safe_options.min_quality = wanted;
        CHECK(safe.run(move) == HM_SHORT);
        INFO(wanted << ": " << safe.report.step_fraction << ", " << safe.error.text);
        CHECK(safe.is_valid());
        CHECK(safe.report.min_quality >= wanted * safe.report.start_quality);
        CHECK(safe.report.step_fraction > 0);
        CHECK(safe.report.step_fraction < last);
        CHECK(says(safe.error,
                   "the meshes found farther on have a smaller quality than was asked for"));
        last = safe.report.step_fraction;
    }
    CHECK(last < 0.1 * safe.report.admissible);
}

TEST_CASE("a body turns with its points and heights, also where a fit is coarse") {
    Case setup;
    Outline const outline = naca4({}, 40);
    setup.mesh = o_mesh(outline, stretched(1e-6, 8, 40));
    setup.curves = fitted_loop(outline.points, 12);
    setup.put_on_curves(body);
    Safe safe(setup);
    safe.safe_options.min_quality = 0;
    REQUIRE(safe.solved().report.max_distance > 1e-4);  // a hundred first layers
    for (double const degrees : {45.0, 170.0}) {
        Complex const turn = std::polar(1.0, degrees * pi / 180), centre(0.25, 0);
        std::vector<double> const move = similarity_move(setup.curves, turn, centre);
        REQUIRE(safe.run(move) == HM_OK);
        CHECK(safe.is_valid());
        CHECK(safe.report.min_height_ratio > 0.9999);
        CHECK(safe.report.max_height_ratio < 1.0001);
        CHECK(safe.report.max_angle_change < 0.01);
        CHECK(safe.report.min_quality > 0.9 * safe.report.start_quality);
        for (std::int32_t const k :
             points_on(setup.mesh, body)) {  // the wall is the start's, turned
            std::size_t const point = std::size_t(k);
            Complex const start(setup.mesh.x[point], setup.mesh.y[point]);
            CHECK(std::abs(Complex(safe.x[point], safe.y[point]) -
                           (centre + turn * (start - centre))) < 1e-13);
        }
        CHECK(safe.report.rotated_offset ==
              doctest::Approx(std::abs(turn - 1.0) * safe.solved().report.max_distance)
                  .epsilon(1e-3));
    }
    // A movement without rotation is the B-spline's movement alone.
    std::vector<double> const shift = similarity_move(setup.curves, 1, 0, {0.1, 0.2});
    REQUIRE(safe.run(shift) == HM_OK);
    CHECK(safe.report.rotated_offset < 1e-15);
    CHECK(safe.boundary_error(shift) < 1e-15);
}

TEST_CASE("a body that was moved and solved again turns as one that was fitted there") {
    Outline const outline = naca4({}, 40);
    Case moved, there;
    moved.mesh = o_mesh(outline, stretched(1e-4, 8, 40));
    moved.curves = fitted_loop(outline.points, 20);
    moved.put_on_curves(body);
    there = moved;
    for (double& x : there.mesh.x) x += 5;
    for (std::size_t k = 0; k < there.curves.control.size(); k += 2) there.curves.control[k] += 5;
    Safe again(moved);
    Solved const& solved = again.solved();
    moved.mesh.x = there.mesh.x;
    hm_points const at = moved.mesh_view().points;  // of the plan
    REQUIRE(hm_plan_factor(solved.plan, &at, nullptr) == HM_OK);
    REQUIRE(hm_plan_solve(solved.plan, solved.basis, nullptr, nullptr) == HM_OK);
    std::vector<double> const move =
        similarity_move(there.curves, std::polar(1.0, pi / 4), Complex(5.25, 0));
    again.run(move);
    INFO(again.error.text);
    REQUIRE(again.status == HM_OK);
    Safe fresh(there);
    REQUIRE(fresh.run(move) == HM_OK);
    double largest = 0;
    for (std::int32_t const k : points_on(there.mesh, body)) {
        std::size_t const point = std::size_t(k);
        largest = std::fmax(
            largest, std::hypot(again.x[point] - fresh.x[point], again.y[point] - fresh.y[point]));
    }
    CHECK(largest < 1e-11);
}

TEST_CASE("heights are restored as far as quality permits, and the report says how far") {
    Case floor = channel(14, 16, 0.004, 20), airfoil;
    airfoil.mesh = o_mesh(naca4({}, 40), stretched(1e-4, 8, 40));
    airfoil.curves = fitted_loop(naca4({}, 40).points, 20);
    airfoil.put_on_curves(body);
    int given_up = 0, restored = 0;
    for (bool const is_airfoil : {false, true}) {
        Safe safe(is_airfoil ? airfoil : floor);
        for (int seed = 7; seed <= 14; seed += is_airfoil ? 1 : 2) {
            std::vector<double> move = deform::random_bump(20, std::uint64_t(seed), 0.5);
            for (std::size_t k = 0; is_airfoil && k < move.size(); k += 2) {  // camber and a wave
                double const x = airfoil.curves.control[k];
                move[k] = 0;
                move[k + 1] = seed * (0.2 * x * (1 - x) + 0.01 * std::sin(15 * x));
            }
            safe.safe_options.min_quality = -1;
            safe.safe_options.heights = 0;
            if (safe.run(move) != HM_OK) continue;
            double const without = safe.report.min_quality;
            CHECK(safe.report.heights == 0);
            safe.safe_options.heights = 1;
            REQUIRE(safe.run(move) == HM_OK);
            INFO((is_airfoil ? "airfoil" : "channel")
                 << ", seed " << seed << ", restored " << safe.report.heights);
            CHECK(safe.is_valid());
            CHECK(safe.report.min_quality >= 0.5 * without);
            // A quality that is reached without the heights is not given up for them.
            safe.safe_options.min_quality =
                std::min(1.0, 0.95 * without / safe.report.start_quality);
            CHECK(safe.run(move) == HM_OK);
            CHECK(safe.report.min_quality >=
                  safe.safe_options.min_quality * safe.report.start_quality);
            given_up += safe.report.heights < 1;
            restored += safe.report.heights > 0;
        }
    }
    CHECK(given_up > 0);
    CHECK(restored > 0);
}

TEST_CASE("a wall that ends beside a fixed line is stopped there, and the end is named") {
    int named = 0;
    for (bool const slips : {false, true}) {
        Case setup = channel(14, 16, 0.004, 12);
        if (slips) setup.set_slip(bottom);
        std::vector<std::int32_t> const wall = points_on(setup.mesh, body);
        Safe safe(setup);
        safe.safe_options.max_resolves = -1;
        safe.safe_options.skipped_strategies =
            1 << HM_STRATEGY_UNTANGLED | 1 << HM_STRATEGY_IMPROVED;
        for (Complex const by :
             {Complex(0, 0.3), Complex(0, -0.3), Complex(0.2, 0.5), Complex(-0.2, 0.1)}) {
            std::vector<double> move(setup.curves.control.size());
            for (std::size_t k = 0; k < 12; ++k) {  // the left end moves most
                double const part = 1 - double(k) / 11;
                move[2 * k] = part * by.real();
                move[2 * k + 1] = part * by.imag();
            }
            hm_status const status = safe.run(move);
            if (status != HM_SHORT) continue;
            std::string const text = safe.error.text;
            named += text.find("the wall's end, point") != std::string::npos;
            CHECK(text.find("off the line of the ") != std::string::npos);
            CHECK(safe.report.end_point == safe.error.item);
            CHECK(safe.report.end_distance == doctest::Approx(std::fabs(by.imag())));
            CHECK(std::find(wall.begin(), wall.end(), safe.error.item) != wall.end());
            auto const end = std::size_t(safe.error.item);
            CHECK(setup.mesh.x[end] == 1);
            CHECK(setup.mesh.y[end] == 0);
        }
    }
    CHECK(named > 0);
}

// A wedge behind a line of symmetry: a grid whose lower side rises from x = 1 on.
TEST_CASE("points on a slip line make room for the end of a wall that leaves the line") {
    constexpr int n_y = 15, n_line = 12, n_control = 6;
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = channel(10, n_y, 0.03, n_control, kind);
        Mesh& mesh = setup.mesh;
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {
            double const floor = std::fmax(0, 0.25 * (mesh.x[k] * 2.5 / 3 - 1));
            mesh.x[k] *= 2.5 / 3;
            mesh.y[k] = floor + mesh.y[k] * (1.5 - floor);
        }
        for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
            auto const at = std::size_t(mesh.faces[2 * face]);
            if (mesh.face_markers[face] == body || mesh.face_markers[face] == bottom)
                mesh.face_markers[face] = at < n_line ? std::int32_t{bottom} : std::int32_t{body};
        }
        setup.curves = straight_wall(1, 2.5, 0, n_control);
        for (std::size_t k = 0; k < n_control; ++k)
            setup.curves.control[2 * k + 1] = 0.25 * (setup.curves.control[2 * k] - 1);
        setup.set_slip(bottom);
        setup.set_slip(top);
        setup.set_slip(right);
        Safe safe(setup);
        struct {
            double dx, dy;
            std::size_t moved;  // control points, from the wall's first end on
            double leaves;      // the farther end
        } const all[] = {{0, 0.15, 6, 0.15},  {0, -0.15, 6, 0.15}, {0, -0.4, 6, 0.4},
                         {0, -0.4, 1, 0.4},   {0, -0.4, 5, 0.4},   {-0.3, 0, 6, 0.3},
                         {-0.3, 0.2, 6, 0.3}, {-0.3, 0, 1, 0},     {0.3, 0, 1, 0}};
        for (auto const& one : all) {
            INFO("cells " << int(kind) << ", by " << one.dx << " " << one.dy << " of "
                          << one.moved);
            std::vector<double> move(2 * n_control, 0.0);
            for (std::size_t k = 0; k < one.moved; ++k) {
                move[2 * k] = one.dx;
                move[2 * k + 1] = one.dy;
            }
            CHECK(safe.run(move) == HM_OK);
            CHECK(safe.is_valid());
            CHECK(safe.report.end_distance == doctest::Approx(one.leaves));
            CHECK((safe.report.end_point >= 0) == (one.leaves > 0));
            for (std::size_t k = 0; k < n_line; ++k) CHECK(std::fabs(safe.y[k]) < 1e-15);
        }
    }
}

TEST_CASE("impossible targets are refused at once with the place, and nothing is written") {
    auto const refused = [](Safe& safe, std::vector<double> const& move, const char* why) {
        CHECK(safe.run(move) == HM_CROSSING);
        CHECK(safe.untouched());
        CHECK(safe.report.resolves == 0);
        std::string const text = safe.error.text;
        INFO(text);
        CHECK(text.find(why) != std::string::npos);
        CHECK(text.find('(') != std::string::npos);
        return safe.error.item;
    };
    // A wall that ends in a corner of the domain and turns by more than 90 degrees out of it:
    // the boundary crosses nothing.
    Case wall = nozzle(20, 8, 0.02, 8);
    Safe corner(wall);
    std::vector<double> move(16, 0.0);
    move[2] = -0.3;
    move[3] = 0.4;
    move[4] = -0.1;
    move[5] = 0.5;
    std::int32_t const cell = refused(corner, move, "inverted by its points on the boundary");
    CHECK(cell == 140);  // the uppermost one at the left side: 7 rows of 20 below
    move[3] = -0.4;      // out of the domain
    move[5] = -0.2;
    refused(corner, move, "crosses itself");

    Case two = two_body_case();
    Safe bodies(two);
    auto const first_by = [&](double scale_x, double scale_y, double shift) {
        std::vector<double> by(40, 0.0);
        for (std::size_t k = 0; k < 22; k += 2) {
            by[k] = (scale_x - 1) * (two.curves.control[k] - 0.5) + shift;
            by[k + 1] = (scale_y - 1) * (two.curves.control[k + 1] - 0.5);
        }
        return by;
    };
    std::vector<std::int32_t> const first = points_on(two.mesh, body);
    auto const is_of_first = [&](std::int32_t k) {
        return std::find(first.begin(), first.end(), k) != first.end();
    };
    CHECK(is_of_first(refused(bodies, first_by(1, 1, 5), "outside the boundary")));
    CHECK(is_of_first(refused(bodies, first_by(0.2, 0.2, 1), "is inside")));
    CHECK(is_of_first(refused(bodies, first_by(1, -1, 0), "inside out")));
    refused(bodies, first_by(1, 1, 0.9), "crosses itself");
    CHECK(bodies.run(first_by(0.2, 0.2, 0.2)) >= HM_OK);  // what is possible is possible
}
