// The fixtures are what they say: without this, tests built on them prove nothing.
#include <doctest/doctest.h>

#include <fixtures/annulus.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/naca0012.hpp>
#include <fixtures/square.hpp>
#include <fixtures/two_bodies.hpp>

using namespace fixtures;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

void check_sound(Mesh const& mesh, int holes, double area, double tolerance) {
    MeshCheck const seen = check(mesh);
    CHECK(seen.min_corner > 0);
    CHECK(seen.bad_edges == 0);
    CHECK(seen.unmarked == 0);
    CHECK(seen.stray == 0);
    CHECK(seen.boundary_edges == mesh.n_faces());
    CHECK(seen.loops == holes + 1);
    CHECK(seen.euler() == 1 - holes);
    CHECK(seen.area == doctest::Approx(area).epsilon(tolerance));
}

double const pi = std::acos(-1.0);

} // namespace

TEST_CASE("annulus: valid, of the right area, also perturbed") {
    for (Cells const kind : kinds) {
        for (bool const geometric : {false, true}) {
            Mesh mesh = annulus(8, 64, 0.5, 2, kind, geometric);
            double const area = 32 * std::sin(2 * pi / 64) * (4 - 0.25);   // of the polygons
            check_sound(mesh, 1, area, 1e-12);
            std::vector<double> const before = mesh.x;
            perturb(mesh, 0.3, 7);
            check_sound(mesh, 1, area, 1e-12);
            CHECK(mesh.x != before);
            CHECK(std::equal(before.begin(), before.begin() + 64, mesh.x.begin()));   // the wall stays
        }
    }
}

TEST_CASE("square: valid with and without a hole") {
    for (Cells const kind : kinds) {
        Mesh whole = square(10, kind), hollow = square(25, kind, 5, 1);
        check_sound(whole, 0, 1, 1e-12);
        check_sound(hollow, 1, 1 - 0.2 * 0.04, 1e-12);
        CHECK(whole.n_points() == 121);
        CHECK(square(12, kind, 4, 6).n_points() == 169 - 3 * 5);
        perturb(whole, 0.4, 1);
        perturb(hollow, 0.4, 2);
        check_sound(whole, 0, 1, 1e-12);
        check_sound(hollow, 1, 1 - 0.2 * 0.04, 1e-12);
    }
}

TEST_CASE("two bodies: valid, and the ellipses have their area") {
    Ellipse const tilted{0.3, 0.06, 0.5};
    for (Cells const kind : kinds) {
        Mesh mesh = two_bodies(40, 10, Ellipse{}, tilted, kind);
        check_sound(mesh, 2, 2 - pi * (0.2 * 0.08 + 0.3 * 0.06), 1e-3);
        perturb(mesh, 0.3, 3);
        check_sound(mesh, 2, 2 - pi * (0.2 * 0.08 + 0.3 * 0.06), 1e-3);
    }
}

TEST_CASE("outlines of airfoils close, and are as thick as they say") {
    for (bool const blunt : {false, true}) {
        Naca4 naca;
        naca.blunt = blunt;
        Outline const outline = naca4(naca, 80);
        double low = 0, high = 0;
        for (Point const p : outline.points) {
            low = std::fmin(low, p.y);
            high = std::fmax(high, p.y);
            CHECK((p.x >= 0 && p.x <= 1));
        }
        CHECK(high - low == doctest::Approx(0.12).epsilon(2e-3));
        CHECK(outline.points[0].x == 1);
        CHECK(outline.points[0].y == doctest::Approx(blunt ? -0.00126 : 0));
        CHECK(outline.base == (blunt ? 5 : 1));
    }
    CHECK(joukowski(0.1, 0.05, 50).points.size() == 100);
}

TEST_CASE("O-meshes round airfoils: no inverted corner at any trailing edge, wall spacing or camber") {
    for (double const first : {5e-3, 1e-4, 1e-6}) {
        std::vector<double> const distances = stretched(first, 20, 60);
        for (double const camber : {0.0, 0.04}) {
            Naca4 sharp, blunt;
            sharp.camber = blunt.camber = camber;
            blunt.blunt = true;
            for (Cells const kind : kinds) check_sound(o_mesh(naca4(sharp, 50), distances, kind), 1, 400 * pi, 5e-3);
            check_sound(o_mesh(naca4(sharp, 50), distances, Cells::quads, 2), 1, 400 * pi, 5e-3);
            check_sound(o_mesh(naca4(blunt, 50), distances), 1, 400 * pi, 5e-3);
            check_sound(o_mesh(joukowski(0.1, camber, 50), distances), 1, 400 * pi, 5e-3);
        }
    }
    Mesh const mesh = o_mesh(naca4({}, 40), stretched(1e-5, 20, 50));
    CHECK(mesh.n_points() == 80 * 51);
    for (std::int32_t k = 0; k < 80; ++k)
        CHECK(distance(mesh.point(k), mesh.point(k + 80)) == doctest::Approx(1e-5).epsilon(1e-4));
}

TEST_CASE("hybrid meshes: quads at the wall, good triangles outside") {
    Naca4 blunt;
    blunt.blunt = true;
    HybridOptions options, only_triangles;
    check_sound(hybrid_mesh(naca4({}, 50), options), 1, 400 * pi, 1e-2);
    options.first = 1e-5;
    options.layers = 30;
    check_sound(hybrid_mesh(naca4({}, 50), options), 1, 400 * pi, 1e-2);
    options.fan = 0;
    check_sound(hybrid_mesh(naca4(blunt, 50), options), 1, 400 * pi, 1e-2);
    only_triangles.layers = 0;
    only_triangles.first = 1e-2;
    Mesh const mesh = hybrid_mesh(naca4({}, 50), only_triangles);
    check_sound(mesh, 1, 400 * pi, 1e-2);
    CHECK(check(mesh).quads == 0);
}

TEST_CASE("meshes for benchmarks: about as many points as asked for") {
    for (int const n : {2000, 30000}) {
        for (Mesh const& mesh : {naca0012_isotropic(n), naca0012_viscous(n), naca0012_triangles(n)}) {
            check_sound(mesh, 1, 400 * pi, 1e-2);
            CHECK(mesh.n_points() == doctest::Approx(n).epsilon(0.1));
        }
    }
}

TEST_CASE("C-mesh: a structured block, valid, whose wake is cut and bit-equal") {
    for (double const first : {2e-3, 1e-5}) {
        CMesh const c = c_mesh(naca4({}, 60), 40, 15, stretched(first, 15, 50));
        MeshCheck const seen = check(c.mesh);
        CHECK(seen.min_corner > 0);
        CHECK(seen.bad_edges == 0);
        CHECK(seen.stray == 0);
        CHECK(seen.unmarked == 2 * c.n_wake);
        CHECK(c.ni * c.nj == c.mesh.n_points());
        CHECK(c.ni == 2 * 40 + 2 * 60 + 1);
        for (std::int32_t k = 0; k <= c.n_wake; ++k) {
            Point const below = c.mesh.point(k), above = c.mesh.point(c.ni - 1 - k);
            CHECK((below.x == above.x && below.y == above.y));
        }
    }
}

TEST_CASE("mangled meshes are still the same mesh") {
    Mesh const origin = hybrid_mesh(naca4({}, 30));
    MeshCheck const before = check(origin);
    Mesh mesh = origin;
    std::vector<std::int32_t> const new_of = renumber_points(mesh, 5);
    CHECK(mesh.point(new_of[17]).x == origin.point(17).x);
    shuffle_cells(mesh, 6);
    rotate_starts(mesh, 7);
    add_unused(mesh, 9, 8);
    split_marker(mesh, body, 3, 31);
    MeshCheck const after = check(mesh);
    CHECK(after.sound());
    CHECK(after.area == doctest::Approx(before.area).epsilon(1e-12));
    CHECK(after.used_points == origin.n_points());
    CHECK(mesh.n_points() == origin.n_points() + 9);
    CHECK(after.euler() == before.euler());
    CHECK(std::count(mesh.face_markers.begin(), mesh.face_markers.end(), body) == 0);
    for (std::int32_t const marker : {31, 32, 33})
        CHECK(std::count(mesh.face_markers.begin(), mesh.face_markers.end(), marker) == 20);
    CHECK(quads_of(mesh).size() == 4 * static_cast<std::size_t>(mesh.n_cells()));

    reverse_all(mesh);
    CHECK(check(mesh).area == doctest::Approx(-before.area).epsilon(1e-12));
    reverse_some(mesh, 9);
    CHECK(check(mesh).bad_edges > 0);
}
