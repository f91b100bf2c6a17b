// The boundary of transferred functions: walls, cuts, slip lines, periodic pairs, rigid bodies,
// thin layers.
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/o_mesh.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/solved.hpp>
#include <fixtures/displaced.hpp>

using namespace fixtures;

TEST_CASE("the wall moves as the B-spline does, exactly; fixed points do not move") {
    Case coarse = two_body_case(Cells::hybrid, 8, 6),
         fine = two_body_case(Cells::triangles, 21, 15);
    Transferred const transferred(fine, coarse);
    std::vector<double> const move = some_move(20, 0.05, 3);
    Moved const to = morphed(transferred.basis, fine.mesh, move);
    CHECK(boundary_error(transferred.basis, move, fine.mesh, to) < 1e-15);
    int fixed = 0;
    for (std::size_t face = 0; face < fine.mesh.face_markers.size(); ++face) {
        if (fine.mesh.face_markers[face] != far_field) continue;
        std::size_t const point = std::size_t(fine.mesh.faces[2 * face]);
        CHECK(to.x[point] == fine.mesh.x[point]);
        CHECK(to.y[point] == fine.mesh.y[point]);
        ++fixed;
    }
    CHECK(fixed > 50);
    CHECK(transferred.transfer.wall_correction > 1e-4);  // there was something to restore
}

TEST_CASE("cuts and seams: both sides get the same bits") {
    auto const case_on = [](Mesh const& mesh) {
        Case out = airfoil_case(24);
        out.mesh = mesh;
        return out;
    };
    Outline const rough = naca4({}, 24), dense = naca4({}, 40);
    CMesh const c_coarse = c_mesh(rough, 10, 3, stretched(2e-3, 5, 20)),
                c_fine = c_mesh(dense, 30, 3, stretched(1e-3, 5, 40));
    Case coarse = case_on(c_coarse.mesh), fine = case_on(c_fine.mesh);
    Transferred const transferred(fine, coarse);
    std::int32_t const last = c_fine.ni - 1;
    for (std::int32_t function = 0; function < fine.curves.n_control(); ++function) {
        std::vector<double> const values = values_of(transferred.basis, function);
        for (std::int32_t k = 0; k < c_fine.n_wake; ++k) {
            CHECK(values[std::size_t(k)] == values[std::size_t(last - k)]);
        }
    }
    CHECK(largest_difference(all_numbers(transferred.basis), all_numbers(Solved(fine).basis)) <
          0.1);
}

TEST_CASE("slipping points stay on their lines, periodic pairs move alike, bit by bit") {
    for (bool const periodic : {false, true}) {
        for (double const angle : {0.0, 0.7}) {
            Case coarse = slip_channel(12, periodic), fine = slip_channel(27, periodic);
            coarse = similar(coarse, std::polar(1.0, angle), 0);
            fine = similar(fine, std::polar(1.0, angle), 0);
            Transferred const transferred(fine, coarse);
            std::vector<double> const move = some_move(4, 1, 5);
            Moved const by = displaced(transferred.basis, move);
            double along = 0;
            for (std::size_t face = 0; face < fine.mesh.face_markers.size(); ++face) {
                std::int32_t const marker = fine.mesh.face_markers[face];
                std::size_t const a = std::size_t(fine.mesh.faces[2 * face]);
                if (marker == bottom || marker == top) {
                    CHECK(std::fabs(by.y[a] * std::cos(angle) - by.x[a] * std::sin(angle)) < 1e-15);
                    along = std::fmax(
                        along, std::fabs(by.x[a] * std::cos(angle) + by.y[a] * std::sin(angle)));
                }
            }
            CHECK(along > 0.02);
            if (!periodic) continue;
            int pairs = 0;
            // Rows of 28 points; left and right are their ends, outside the hole's rows.
            for (std::size_t k = 0; k < by.x.size(); ++k) {
                if (k / 28 > 5 || k % 28 != 0) continue;
                CHECK(by.x[k] == by.x[k + 27]);
                CHECK(by.y[k] == by.y[k + 27]);
                pairs += by.x[k] != 0 ? 1 : 0;
            }
            CHECK(pairs > 3);
        }
    }
}

TEST_CASE("the correction at a wall that meets a slip line does not push points off the line") {
    auto const slanting = [](int n) {
        Case out;
        out.mesh = square(n);
        for (std::size_t k = 0; k < out.mesh.x.size(); ++k) out.mesh.x[k] += 0.5 * out.mesh.y[k];
        Spline wall;
        wall.degree = 3;
        for (double const t : {0.0, 0.1, 0.3, 0.6, 0.85, 1.0}) {
            wall.control.push_back(0.5 * t);
            wall.control.push_back(t);
        }
        wall.knots = clamped_knots(3, 6);
        out.curves = wall;
        out.put_on_curves(left);
        out.set_slip(bottom);
        out.set_slip(top);
        return out;
    };
    Case coarse = slanting(5), fine = slanting(17);
    Transferred const transferred(fine, coarse);
    REQUIRE(transferred.transfer.wall_correction > 0.01);
    Moved const by = displaced(transferred.basis, some_move(6, 1, 5));
    for (std::size_t k = 1; k < 17; ++k) {
        CHECK(by.x[k] != 0);
        CHECK(by.y[k] == 0);
    }
}

TEST_CASE("rigid bodies: points on them move rigidly") {
    auto const case_on = [](int m, int n_r) {
        Case out = two_body_case(Cells::quads, m, n_r);
        out.conditions.pop_back();
        out.set_rigid(second_body, 1.5, 0.5);
        return out;
    };
    Case coarse = case_on(8, 6), fine = case_on(20, 14);
    Transferred const transferred(fine, coarse);
    std::vector<double> move(2 * (20 + 2), 0.0);
    move[40] = 0.1;
    move[42] = -0.3;  // s - 1
    move[43] = 0.2;
    Moved const by = displaced(transferred.basis, move);
    for (std::size_t face = 0; face < fine.mesh.face_markers.size(); ++face) {
        if (fine.mesh.face_markers[face] != second_body) continue;
        std::size_t const k = std::size_t(fine.mesh.faces[2 * face]);
        double const x = fine.mesh.x[k] - 1.5, y = fine.mesh.y[k] - 0.5;
        CHECK(by.x[k] == doctest::Approx(0.1 - 0.3 * x - 0.2 * y).epsilon(1e-12));
        CHECK(by.y[k] == doctest::Approx(-0.3 * y + 0.2 * x).epsilon(1e-12));
    }
    fine.conditions.back().x = 1.4;
    TransferAttempt refused;
    REQUIRE(refused.open(fine.problem()));
    CHECK(!refused.fill_from(Solved(coarse).basis, coarse.mesh_view()));
    CHECK(refused.status == HM_BAD_BASIS);
    CHECK(std::string(refused.error.text) ==
          "the two bases have different rigid bodies, or bodies with different centres");
}

TEST_CASE("thin layers stay valid because points near the wall move along with the correction") {
    auto const viscous = [](int n_side, double first, int layers) {
        Case out = airfoil_case(n_side);
        Naca4 naca;
        naca.camber = 0.02;
        HybridOptions options;
        options.radius = 8;
        options.first = first;
        options.layers = layers;
        out.mesh = hybrid_mesh(naca4(naca, n_side), options);
        return out;
    };
    Case coarse = viscous(30, 2e-5, 22), fine = viscous(70, 1e-5, 26);
    Options const options = options_of(HM_CONFORMAL);
    for (Options const* chosen : {static_cast<Options const*>(nullptr), &options}) {
        Solved const solved(fine, chosen);
        Transferred const transferred(fine, coarse, chosen);
        CHECK(transferred.transfer.wall_correction >
              100 * 1e-5);  // many times the height of a first cell
        for (unsigned const seed : {1u, 2u, 3u}) {
            std::vector<double> const move = some_move(fine.curves.n_control(), 0.02, seed);
            auto const admissible = [&](const hm_basis* basis) {
                return step_of(basis, fine.mesh_view(), displaced(basis, move)).admissible;
            };
            double const own = admissible(solved.basis), found = admissible(transferred.basis);
            INFO("admissible " << found << ", of functions solved on the fine mesh " << own);
            CHECK(found > 0.8 * own);
        }
    }
}
