// The boundary of transferred functions: walls, cuts, slip lines, periodic pairs, rigid bodies,
// thin layers.
#include <harmorph_study.h>
#include "fixtures/options.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/slip_channel.hpp>
#include <fixtures/transferred.hpp>

using namespace fixtures;

namespace {

std::vector<double> moved(hm_basis const* basis, std::vector<double> const& move, std::size_t n) {
    std::vector<double> out(2 * n);
    REQUIRE(hm_morph(basis, move.data(), nullptr, points_out(out.data(), out.data() + n), nullptr,
                     nullptr) == HM_OK);
    return out;
}

double admissible(hm_basis const* basis, Case& setup, std::vector<double> const& move) {
    std::size_t const n = setup.mesh.x.size();
    std::vector<double> const by = moved(basis, move, n);
    auto step = sized<hm_step_report>();
    REQUIRE(hm_assess(basis, &setup.mesh_view(), nullptr, points_in(by.data(), by.data() + n),
                      nullptr, nullptr, &step, nullptr, nullptr) == HM_OK);
    return step.admissible;
}

}  // namespace

TEST_CASE("the wall moves as the B-spline does, exactly; fixed points do not move") {
    Case coarse = two_body_case(Cells::hybrid, 8, 6),
         fine = two_body_case(Cells::triangles, 21, 15);
    Transferred const transferred(fine, coarse);
    std::vector<double> const move = some_move(20, 0.05, 3);
    std::size_t const n = fine.mesh.x.size();
    std::vector<double> x(n), y(n);
    hm_mesh const mesh = fine.mesh_view();
    REQUIRE(hm_morph(transferred.basis, move.data(), &mesh.points, points_out(x, y), nullptr,
                     nullptr) == HM_OK);
    double error = 1;
    REQUIRE(hm_boundary_error(transferred.basis, move.data(), &mesh.points, points_in(x, y), &error,
                              nullptr, nullptr) == HM_OK);
    CHECK(error < 1e-15);
    int fixed = 0;
    for (std::size_t face = 0; face < fine.mesh.face_markers.size(); ++face) {
        if (fine.mesh.face_markers[face] != far_field) continue;
        std::size_t const point = static_cast<std::size_t>(fine.mesh.faces[2 * face]);
        CHECK(x[point] == fine.mesh.x[point]);
        CHECK(y[point] == fine.mesh.y[point]);
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
            CHECK(values[static_cast<std::size_t>(k)] ==
                  values[static_cast<std::size_t>(last - k)]);
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
            std::size_t const n = fine.mesh.x.size();
            std::vector<double> const by = moved(transferred.basis, move, n);
            double along = 0;
            for (std::size_t face = 0; face < fine.mesh.face_markers.size(); ++face) {
                std::int32_t const marker = fine.mesh.face_markers[face];
                std::size_t const a = static_cast<std::size_t>(fine.mesh.faces[2 * face]);
                if (marker == bottom || marker == top) {
                    CHECK(std::fabs(by[n + a] * std::cos(angle) - by[a] * std::sin(angle)) < 1e-15);
                    along = std::fmax(
                        along, std::fabs(by[a] * std::cos(angle) + by[n + a] * std::sin(angle)));
                }
            }
            CHECK(along > 0.02);
            if (!periodic) continue;
            int pairs = 0;
            // Rows of 28 points; left and right are their ends, outside the hole's rows.
            for (std::size_t k = 0; k < n; ++k) {
                if (k / 28 > 5 || k % 28 != 0) continue;
                CHECK(by[k] == by[k + 27]);
                CHECK(by[n + k] == by[n + k + 27]);
                pairs += by[k] != 0 ? 1 : 0;
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
    std::vector<double> const by = moved(transferred.basis, some_move(6, 1, 5), fine.mesh.x.size());
    for (std::size_t k = 1; k < 17; ++k) {
        CHECK(by[k] != 0);
        CHECK(by[fine.mesh.x.size() + k] == 0);
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
    std::size_t const n = fine.mesh.x.size();
    std::vector<double> const by = moved(transferred.basis, move, n);
    for (std::size_t face = 0; face < fine.mesh.face_markers.size(); ++face) {
        if (fine.mesh.face_markers[face] != second_body) continue;
        std::size_t const k = static_cast<std::size_t>(fine.mesh.faces[2 * face]);
        double const x = fine.mesh.x[k] - 1.5, y = fine.mesh.y[k] - 0.5;
        CHECK(by[k] == doctest::Approx(0.1 - 0.3 * x - 0.2 * y).epsilon(1e-12));
        CHECK(by[n + k] == doctest::Approx(-0.3 * y + 0.2 * x).epsilon(1e-12));
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
            double const own = admissible(solved.basis, fine, move),
                         found = admissible(transferred.basis, fine, move);
            INFO("admissible " << found << ", of functions solved on the fine mesh " << own);
            CHECK(found > 0.8 * own);
        }
    }
}
