// Functions of a coarse mesh on a fine one: exact where they are linear, second order elsewhere, and the boundary's own.
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/transferred.hpp>

using namespace fixtures;

namespace {

double const pi = std::acos(-1.0);
constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

hm_options conformal() {
    hm_options out{};
    out.struct_size = sizeof out;
    return out;
}

// Unit square on a polygon of degree 1 through its corners and more points: positions are sums of the functions.
Case cage(int n, Cells kind, double perturbed = 0) {
    Case out;
    out.mesh = square(n, kind);
    if (perturbed > 0) perturb(out.mesh, perturbed, 17);
    out.curves = polyline({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.5}});
    for (std::int32_t const side : {bottom, right, top, left}) out.put_on_curves(side);
    return out;
}

// An annulus whose inner or outer circle is on the curve; parameters by the angle.
Case wall_case(int n_r, int n_t, Cells kind, bool outer) {
    Case out = ring_case(n_r, n_t, 0.5, 2, kind);
    if (!outer) return out;
    out.curves = ring(3, 8, 2, 2);
    out.conditions[0].marker = far_field;
    for (std::int32_t& point : out.given_points) point += n_r * n_t;
    return out;
}

std::vector<double> coordinate(std::vector<double> const& control, std::size_t which) {
    std::vector<double> out;
    for (std::size_t k = which; k < control.size(); k += 2) out.push_back(control[k]);
    return out;
}

std::vector<double> combined(hm_basis const* basis, std::vector<double> const& amount) {
    std::vector<double> out;
    for (std::size_t i = 0; i < amount.size(); ++i) {
        std::vector<double> const one = values_of(basis, static_cast<std::int32_t>(i));
        out.resize(one.size(), 0.0);
        for (std::size_t k = 0; k < one.size(); ++k) out[k] += amount[i] * one[k];
    }
    return out;
}

// A channel with a body: bottom and top slip, left and right are a periodic pair or fixed.
Case channel(int n, bool periodic) {
    Case out;
    out.mesh = square(n, Cells::hybrid, n / 3, n / 3);
    out.curves = polyline({{1.0 / 3, 1.0 / 3}, {2.0 / 3, 1.0 / 3}, {2.0 / 3, 2.0 / 3}, {1.0 / 3, 2.0 / 3}});
    out.put_on_curves(body);
    out.set_slip(bottom);
    out.set_slip(top);
    if (periodic) out.set_periodic(left, right);
    return out;
}

// The same mesh about the origin, turned: slip lines along no axis.
void turn(Case& its, double angle) {
    double const c = std::cos(angle), s = std::sin(angle);
    auto const turned = [&](double& x, double& y) {
        double const old = x;
        x = c * old - s * y;
        y = s * old + c * y;
    };
    for (std::size_t k = 0; k < its.mesh.x.size(); ++k) turned(its.mesh.x[k], its.mesh.y[k]);
    for (std::size_t k = 0; k < its.curves.control.size(); k += 2) turned(its.curves.control[k], its.curves.control[k + 1]);
}

std::vector<double> moved(hm_basis const* basis, std::vector<double> const& move, std::size_t n) {
    std::vector<double> out(2 * n);
    REQUIRE(hm_morph(basis, move.data(), nullptr, points_out(out.data(), out.data() + n), nullptr, nullptr) == HM_OK);
    return out;
}

double admissible(hm_basis const* basis, Case& its, std::vector<double> const& move) {
    std::size_t const n = its.mesh.x.size();
    std::vector<double> const by = moved(basis, move, n);
    hm_step_report step{};
    step.struct_size = sizeof step;
    REQUIRE(hm_admissible_step(basis, &its.mesh_view(), nullptr, points_in(by.data(), by.data() + n), nullptr, &step,
                               nullptr) == HM_OK);
    return step.admissible;
}

}  // namespace

TEST_CASE("from a mesh to itself: every number stays, whatever the kind of values") {
    hm_options const options = conformal();
    for (hm_options const* its_options : {static_cast<hm_options const*>(nullptr), &options}) {
        for (int which = 0; which < 4; ++which) {
            Case its = which == 0 ? two_body_case() : which == 1 ? airfoil_case(20) : channel(12, which == 3);
            Solved const solved(its, its_options);
            Transferred const same(its, solved, its.mesh_view(), its_options);
            CHECK(largest_difference(all_numbers(same.basis), all_numbers(solved.basis)) <= 1e-15);
            CHECK(same.transfer.outside == 0);
            CHECK(same.transfer.max_distance_point == -1);
            CHECK(same.transfer.wall_correction <= 1e-15);
        }
    }
}

TEST_CASE("linear fields are exact, on meshes that have nothing in common") {
    for (Cells const from : kinds) {
        for (Cells const to : kinds) {
            Case coarse = cage(8, from, 0.2), fine = cage(20, to, 0.25);
            Transferred const transferred(fine, coarse);
            std::vector<double> const& control = fine.curves.control;
            CHECK(largest_difference(combined(transferred.basis, coordinate(control, 0)), fine.mesh.x) < 1e-12);
            CHECK(largest_difference(combined(transferred.basis, coordinate(control, 1)), fine.mesh.y) < 1e-12);
            CHECK(transferred.transfer.boundary_error <= 1e-15);
            CHECK(transferred.transfer.points == 19 * 19);
        }
    }
}

TEST_CASE("curved walls: second order against the functions solved on the fine mesh, real and complex") {
    hm_options const other = conformal();
    for (hm_options const* options : {static_cast<hm_options const*>(nullptr), &other}) {
        for (Cells const kind : kinds) {
            for (bool const outer : {false, true}) {
                Case fine = wall_case(26, 190, kind, outer);
                std::vector<double> const exact = all_numbers(Solved(fine, options).basis);
                double before = 0;
                for (int const refine : {1, 2, 4}) {
                    Case coarse = wall_case(4 * refine, 32 * refine, Cells::hybrid, outer);
                    Transferred const transferred(fine, coarse, options);
                    double const error = largest_difference(all_numbers(transferred.basis), exact);
                    INFO("refined " << refine << "-fold: " << error << " after " << before);
                    if (refine > 1) CHECK(std::log2(before / error) > 1.5);
                    CHECK(transferred.transfer.boundary_error <= 1e-15);
                    // The coarse mesh does not reach the outer circle, but passes the inner one.
                    CHECK((transferred.transfer.outside > 0) == outer);
                    double const rise = 2 * (1 - std::cos(pi / (32 * refine)));
                    CHECK(transferred.transfer.max_distance <= rise * 1.001);
                    if (outer) CHECK(transferred.transfer.max_distance > rise * 0.8);
                    before = error;
                }
                CHECK(before < 8e-3);
            }
        }
    }
}

TEST_CASE("the wall moves as the B-spline does, exactly; fixed points do not move") {
    Case coarse = two_body_case(Cells::hybrid, 8, 6), fine = two_body_case(Cells::triangles, 21, 15);
    Transferred const transferred(fine, coarse);
    std::vector<double> const move = some_move(20, 0.05, 3);
    std::size_t const n = fine.mesh.x.size();
    std::vector<double> x(n), y(n);
    hm_mesh const mesh = fine.mesh_view();
    REQUIRE(hm_morph(transferred.basis, move.data(), &mesh.points, points_out(x, y), nullptr, nullptr) == HM_OK);
    double error = 1;
    REQUIRE(hm_boundary_error(transferred.basis, move.data(), &mesh.points, points_in(x, y), &error, nullptr,
                              nullptr) == HM_OK);
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
    CHECK(transferred.transfer.wall_correction > 1e-4);   // there was something to restore
}

TEST_CASE("cuts and seams: both sides get the same bits, from meshes with a cut and without") {
    auto const its_case = [](Mesh const& mesh) {
        Case out = airfoil_case(24);
        out.mesh = mesh;
        return out;
    };
    Outline const rough = naca4({}, 24), dense = naca4({}, 40);
    CMesh const c_coarse = c_mesh(rough, 10, 3, stretched(2e-3, 5, 20)), c_fine = c_mesh(dense, 30, 3, stretched(1e-3, 5, 40));
    Case coarse = its_case(c_coarse.mesh), fine = its_case(c_fine.mesh);
    Transferred const transferred(fine, coarse);
    std::int32_t const last = c_fine.ni - 1;
    for (std::int32_t function = 0; function < fine.curves.n_control(); ++function) {
        std::vector<double> const values = values_of(transferred.basis, function);
        for (std::int32_t k = 0; k < c_fine.n_wake; ++k) {
            CHECK(values[static_cast<std::size_t>(k)] == values[static_cast<std::size_t>(last - k)]);
        }
    }
    CHECK(largest_difference(all_numbers(transferred.basis), all_numbers(Solved(fine).basis)) < 0.1);
}

TEST_CASE("slipping points stay on their lines, periodic pairs move alike, bit by bit") {
    for (bool const periodic : {false, true}) {
        for (double const angle : {0.0, 0.7}) {
            Case coarse = channel(12, periodic), fine = channel(27, periodic);
            turn(coarse, angle);
            turn(fine, angle);
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
                    along = std::fmax(along, std::fabs(by[a] * std::cos(angle) + by[n + a] * std::sin(angle)));
                }
            }
            CHECK(along > 0.02);
            if (!periodic) continue;
            int pairs = 0;
            for (std::size_t k = 0; k < n; ++k) {   // rows of 28 points; left and right are their ends, outside the hole's rows
                if (k / 28 > 5 || k % 28 != 0) continue;
                CHECK(by[k] == by[k + 27]);
                CHECK(by[n + k] == by[n + k + 27]);
                pairs += by[k] != 0 ? 1 : 0;
            }
            CHECK(pairs > 3);
        }
    }
}

TEST_CASE("what is restored on a wall that meets a slip line at an angle does not push points off the line") {
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
    auto const its_case = [](int m, int n_r) {
        Case out = two_body_case(Cells::quads, m, n_r);
        out.conditions.pop_back();
        out.set_rigid(second_body, 1.5, 0.5);
        return out;
    };
    Case coarse = its_case(8, 6), fine = its_case(20, 14);
    Transferred const transferred(fine, coarse);
    std::vector<double> move(2 * (20 + 2), 0.0);
    move[40] = 0.1;
    move[42] = -0.3;   // s - 1
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
}

TEST_CASE("thin layers stay valid: the points near the wall move along with what is restored there") {
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
    hm_options const options = conformal();
    for (hm_options const* its : {static_cast<hm_options const*>(nullptr), &options}) {
        Solved const solved(fine, its);
        Transferred const transferred(fine, coarse, its);
        CHECK(transferred.transfer.wall_correction > 100 * 1e-5);   // many times the height of a first cell
        for (unsigned const seed : {1u, 2u, 3u}) {
            std::vector<double> const move = some_move(fine.curves.n_control(), 0.02, seed);
            double const own = admissible(solved.basis, fine, move), found = admissible(transferred.basis, fine, move);
            INFO("admissible " << found << ", of functions solved on the fine mesh " << own);
            CHECK(found > 0.8 * own);
        }
    }
}

TEST_CASE("neither numbering nor threads matter") {
    Case coarse = airfoil_case(20), fine = airfoil_case(45);
    Transferred const plain(fine, coarse);
    std::vector<double> const expected = all_numbers(plain.basis);

    Backwards threads;
    hm_executor const executor = threads.executor(4);
    hm_options options = laplace();
    options.executor = &executor;
    Transferred const threaded(fine, coarse, &options);
    CHECK(threads.calls > 0);
    CHECK(same_bits(all_numbers(threaded.basis), expected));

    Case other_coarse = coarse, other_fine = fine;
    for (Case* its : {&other_coarse, &other_fine}) {
        shuffle_cells(its->mesh, 3);
        reverse_some(its->mesh, 4);
        rotate_starts(its->mesh, 5);
        reverse_some_faces(its->mesh, 6);
        its->index_base = 1;
    }
    renumber_points(other_coarse.mesh, 7);
    std::vector<std::int32_t> const new_of = renumber_points(other_fine.mesh, 8);
    Transferred const renumbered(other_fine, other_coarse);
    double worst = 0;
    for (std::int32_t function = 0; function < fine.curves.n_control(); ++function) {
        std::vector<double> const a = values_of(plain.basis, function), b = values_of(renumbered.basis, function);
        for (std::size_t k = 0; k < a.size(); ++k)
            worst = std::fmax(worst, std::fabs(a[k] - b[static_cast<std::size_t>(new_of[k])]));
    }
    CHECK(worst < 1e-10);
}

TEST_CASE("a transferred basis is a basis: attached again, it morphs the same") {
    Case coarse = ring_case(4, 32, 0.5, 2), fine = ring_case(9, 70, 0.5, 2);
    Transferred const transferred(fine, coarse);
    hm_basis_info info{};
    info.struct_size = sizeof info;
    REQUIRE(hm_basis_info_get(transferred.basis, &info, nullptr) == HM_OK);
    std::vector<double> copy(info.bytes / 8 + 1);
    std::memcpy(copy.data(), transferred.basis, info.bytes);
    hm_basis const* again = nullptr;
    REQUIRE(hm_basis_attach(&again, copy.data(), info.bytes, &fine.mesh_view(), nullptr) == HM_OK);
    CHECK(same_bits(all_numbers(again), all_numbers(transferred.basis)));
}

TEST_CASE("refused: other domains, curves, operators, meshes; and too little memory") {
    Case coarse = ring_case(4, 32, 0.5, 2), fine = ring_case(9, 70, 0.5, 2);
    Solved const solved(coarse);
    auto const refused = [&](Case& its, hm_mesh const& coarse_mesh, hm_options const* options = nullptr) {
        TransferAttempt attempt;
        REQUIRE(attempt.open(its.problem(), options));
        REQUIRE(!attempt.fill_from(solved.basis, coarse_mesh));
        CHECK(attempt.guards_intact());
        CHECK(attempt.block->guards_intact());
        std::vector<double> values(its.mesh.x.size());
        CHECK(hm_basis_values(attempt.basis, 0, 0, values.data(), nullptr) == HM_BAD_BASIS);   // not solved
        INFO(attempt.error.text);
        return attempt.error;
    };
    SUBCASE("a larger domain: the point and its distance") {
        Case larger = ring_case(9, 70, 0.5, 3);
        larger.index_base = 1;
        hm_error const error = refused(larger, coarse.mesh_view());
        CHECK(error.code == HM_BAD_MESH);
        Point const p = larger.mesh.point(error.item - 1);
        CHECK(error.value > 0.1);
        CHECK(error.value == doctest::Approx(std::sqrt(p.x * p.x + p.y * p.y) - 2).epsilon(0.02));
    }
    SUBCASE("a wall that is somewhere else") {
        Case shifted = fine;
        for (double& x : shifted.mesh.x) x += 0.5;
        CHECK(refused(shifted, coarse.mesh_view()).code == HM_BAD_MESH);
    }
    SUBCASE("other curves") {
        Case other = fine;
        other.curves = ring(3, 8, 0.5, 0.500001);
        CHECK(refused(other, coarse.mesh_view()).code == HM_BAD_BASIS);
        other.curves = ring(2, 8, 0.5, 0.5);
        CHECK(refused(other, coarse.mesh_view()).code == HM_BAD_BASIS);
        other = ring_case(9, 70, 0.5, 2, Cells::quads, 3, 9);
        CHECK(refused(other, coarse.mesh_view()).code == HM_BAD_BASIS);
    }
    SUBCASE("another operator") {
        hm_options options = laplace();
        options.operator_kind = HM_WEIGHTED;
        CHECK(refused(fine, coarse.mesh_view(), &options).code == HM_BAD_BASIS);
    }
    SUBCASE("a coarse mesh that is not the one of the coarse basis, or has moved") {
        CHECK(refused(fine, fine.mesh_view()).code == HM_BAD_BASIS);
        Case moved_coarse = coarse;
        moved_coarse.mesh.x[40] += 1e-9;
        CHECK(refused(fine, moved_coarse.mesh_view()).code == HM_BAD_BASIS);
    }
    SUBCASE("a coarse basis that is not solved; a basis of another analysis; NULL") {
        Attempt unsolved, other;
        REQUIRE(unsolved.analyse(coarse.problem()));
        REQUIRE(unsolved.prepare());
        TransferAttempt attempt;
        REQUIRE(attempt.open(fine.problem()));
        CHECK(!attempt.fill_from(unsolved.basis, coarse.mesh_view()));
        CHECK(attempt.status == HM_BAD_BASIS);
        hm_mesh const mesh = coarse.mesh_view();
        std::vector<double> space(attempt.block->size() / 8 + 8);
        std::size_t const bytes = attempt.block->size();
        auto const transfer = [&](hm_basis* to, void* block, hm_analysis const* with, hm_basis const* from, hm_mesh const* on) {
            return hm_transfer(to, block, bytes, with, from, on, nullptr, nullptr);
        };
        CHECK(transfer(unsolved.basis, space.data(), attempt.analysis, solved.basis, &mesh) == HM_BAD_BASIS);
        CHECK(transfer(nullptr, space.data(), attempt.analysis, solved.basis, &mesh) == HM_BAD_ARGUMENT);
        CHECK(transfer(attempt.basis, nullptr, attempt.analysis, solved.basis, &mesh) == HM_BAD_ARGUMENT);
        CHECK(transfer(attempt.basis, space.data(), nullptr, solved.basis, &mesh) == HM_BAD_ARGUMENT);
        CHECK(transfer(attempt.basis, space.data(), attempt.analysis, nullptr, &mesh) == HM_BAD_ARGUMENT);
        CHECK(transfer(attempt.basis, space.data(), attempt.analysis, solved.basis, nullptr) == HM_BAD_ARGUMENT);
        CHECK(transfer(attempt.basis, space.data(), attempt.analysis, solved.basis, &mesh) == HM_OK);
    }
}

TEST_CASE("blocks that are too small are refused, at any alignment") {
    Case coarse = ring_case(3, 16, 0.5, 2), fine = ring_case(5, 30, 0.5, 2);
    Solved const solved(coarse);
    TransferAttempt attempt;
    REQUIRE(attempt.open(fine.problem()));
    hm_mesh const mesh = coarse.mesh_view();
    std::size_t need = 0;
    REQUIRE(hm_transfer_size(attempt.analysis, &mesh, &need, nullptr) == HM_OK);
    for (std::size_t const shift : {0u, 1u, 40u, 63u}) {
        for (std::size_t give = 0; give <= need; give += give + 200 < need || give == need ? 61 : 1) {
            Guarded block(give, shift);
            hm_error error{};
            hm_status const status =
                hm_transfer(attempt.basis, block.data(), give, attempt.analysis, solved.basis, &mesh, nullptr, &error);
            CHECK(status == (give == need ? HM_OK : HM_BLOCK_TOO_SMALL));
            CHECK(block.guards_intact());
            if (give < need) CHECK(error.value == static_cast<double>(need - give));
        }
    }
}
