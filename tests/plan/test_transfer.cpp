// Functions of a coarse mesh on a fine one: exact where they are linear, of second order elsewhere.
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/operators.hpp>
#include <fixtures/solved.hpp>
#include <fixtures/displaced.hpp>

using namespace fixtures;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// Unit square on a polygon of degree 1 through its corners and more points: positions are sums of
// the functions.
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
    for (std::int32_t& point : out.known_points) point += n_r * n_t;
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
        std::vector<double> const one = values_of(basis, std::int32_t(i));
        out.resize(one.size(), 0.0);
        for (std::size_t k = 0; k < one.size(); ++k) out[k] += amount[i] * one[k];
    }
    return out;
}

}  // namespace

TEST_CASE("a transfer from a mesh to the same mesh keeps every number, for each kind of values") {
    Options const options = options_of(HM_CONFORMAL);
    for (Options const* given_options : {static_cast<Options const*>(nullptr), &options}) {
        for (int which = 0; which < 4; ++which) {
            Case setup = which == 0   ? two_body_case()
                         : which == 1 ? airfoil_case(20)
                                      : slip_channel(12, which == 3);
            Solved const solved(setup, given_options);
            Transferred const same(setup, solved, setup.mesh_view(), given_options);
            CHECK(largest_difference(all_numbers(same.basis), all_numbers(solved.basis)) <= 1e-15);
            CHECK(same.transfer.outside == 0);
            CHECK(same.transfer.max_distance_point == -1);
            CHECK(same.transfer.wall_correction <= 1e-15);
        }
    }
}

TEST_CASE("linear fields are exact, between meshes that share no points") {
    for (Cells const from : kinds) {
        for (Cells const to : kinds) {
            Case coarse = cage(8, from, 0.2), fine = cage(20, to, 0.25);
            Transferred const transferred(fine, coarse);
            std::vector<double> const& control = fine.curves.control;
            CHECK(largest_difference(combined(transferred.basis, coordinate(control, 0)),
                                     fine.mesh.x) < 1e-12);
            CHECK(largest_difference(combined(transferred.basis, coordinate(control, 1)),
                                     fine.mesh.y) < 1e-12);
            CHECK(transferred.transfer.boundary_error <= 1e-15);
            CHECK(transferred.transfer.points == 19 * 19);
        }
    }
}

TEST_CASE("transfer between curved walls has second order for real and complex functions") {
    Options const other = options_of(HM_CONFORMAL);
    for (Options const* options : {static_cast<Options const*>(nullptr), &other}) {
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

TEST_CASE("transferred functions depend neither on the numbering nor on threads") {
    Case coarse = airfoil_case(20), fine = airfoil_case(45);
    Transferred const plain(fine, coarse);
    std::vector<double> const expected = all_numbers(plain.basis);

    Backwards threads;
    hm_executor const executor = threads.executor(4);
    Options options = laplace();
    options.executor = &executor;
    Transferred const threaded(fine, coarse, &options);
    CHECK(threads.calls > 0);
    CHECK(same_bits(all_numbers(threaded.basis), expected));

    Case other_coarse = coarse, other_fine = fine;
    for (Case* setup : {&other_coarse, &other_fine}) {
        shuffle_cells(setup->mesh, 3);
        reverse_some(setup->mesh, 4);
        rotate_starts(setup->mesh, 5);
        reverse_some_faces(setup->mesh, 6);
        setup->index_base = 1;
    }
    renumber_points(other_coarse.mesh, 7);
    std::vector<std::int32_t> const new_of = renumber_points(other_fine.mesh, 8);
    Transferred const renumbered(other_fine, other_coarse);
    double worst = 0;
    for (std::int32_t function = 0; function < fine.curves.n_control(); ++function) {
        std::vector<double> const a = values_of(plain.basis, function),
                                  b = values_of(renumbered.basis, function);
        for (std::size_t k = 0; k < a.size(); ++k)
            worst = std::fmax(worst, std::fabs(a[k] - b[std::size_t(new_of[k])]));
    }
    CHECK(worst < 1e-10);
}

TEST_CASE("a transferred basis is a basis: attached again, it morphs the same") {
    Case coarse = ring_case(4, 32, 0.5, 2), fine = ring_case(9, 70, 0.5, 2);
    Transferred const transferred(fine, coarse);
    auto info = sized<hm_basis_info>();
    REQUIRE(hm_basis_info_get(transferred.basis, &info, nullptr) == HM_OK);
    std::vector<double> copy(info.bytes / 8 + 1);
    std::memcpy(copy.data(), transferred.basis, info.bytes);
    hm_basis const* again = nullptr;
    REQUIRE(hm_basis_attach(&again, copy.data(), info.bytes, &fine.mesh_view(), nullptr) == HM_OK);
    CHECK(same_bits(all_numbers(again), all_numbers(transferred.basis)));
}

namespace {

// The values of points in the triangle of a mesh that contains a place; false where no triangle
// does. Every triangle is looked at.
bool interpolated(Mesh const& mesh, std::vector<double> const& values, Point p, double& out) {
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const std::int32_t* const corner = &mesh.cells[std::size_t(3 * cell)];
        Point const a = mesh.point(corner[0]), b = mesh.point(corner[1]), c = mesh.point(corner[2]);
        auto const twice = [](Point u, Point v, Point w) {
            return (v.x - u.x) * (w.y - u.y) - (v.y - u.y) * (w.x - u.x);
        };
        double const area = twice(a, b, c), in_a = twice(p, b, c) / area,
                     in_b = twice(a, p, c) / area, in_c = twice(a, b, p) / area;
        if (in_a < 0 || in_b < 0 || in_c < 0) continue;
        auto const value = [&](int k) { return values[std::size_t(corner[k])]; };
        out = in_a * value(0) + in_b * value(1) + in_c * value(2);
        return true;
    }
    return false;
}

}  // namespace

TEST_CASE("values on an unrelated mesh are those of the coarse triangle that contains the point") {
    Case coarse = ring_case(5, 34, 0.5, 2, Cells::triangles),
         fine = ring_case(8, 61, 0.5, 2, Cells::hybrid);
    perturb(coarse.mesh, 0.15, 3);
    perturb(fine.mesh, 0.2, 9);
    Transferred const transferred(fine, coarse);
    Solved const solved(coarse);
    double const beyond_the_wall =
        0.5 + 0.6;  // farther from the wall than the longest side of a cell beside the wall
    int checked = 0;
    for (std::int32_t function = 0; function < solved.info().functions; ++function) {
        std::vector<double> const from = values_of(solved.basis, function),
                                  to = values_of(transferred.basis, function);
        double worst = 0;
        for (std::int32_t k = 0; k < fine.mesh.n_points(); ++k) {
            Point const p = fine.mesh.point(k);
            double const r = std::hypot(p.x, p.y);
            double expected = 0;
            if (r < beyond_the_wall || r > 1.99 || !interpolated(coarse.mesh, from, p, expected))
                continue;
            worst = std::max(worst, std::fabs(to[std::size_t(k)] - expected));
            ++checked;
        }
        CHECK(worst < 1e-13);
    }
    CHECK(checked > 1000);
}
