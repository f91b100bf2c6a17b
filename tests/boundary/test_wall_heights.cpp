// Heights above the walls brought back after conformal maps, whose stretch is known; and what must
// stay as it is.
#include <fixtures/airfoil.hpp>
#include <fixtures/check.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/core.hpp>

using namespace fixtures;
using harmorph::FirstLayerChange;
using harmorph::Index;

namespace {

// z + a z^2: angles are kept, lengths are scaled by |1 + 2 a z|.
struct Quadratic {
    double a;
    Point operator()(Point p) const {
        return {p.x + a * (p.x * p.x - p.y * p.y), p.y + 2 * a * p.x * p.y};
    }
};

double moved(Walls const& walls, Mesh const& from, Index k) {
    return distance(walls.deformed.point(k), from.point(k));
}

bool is_still(Walls const& walls, Mesh const& from) {
    return same_bits(walls.deformed.x, from.x) && same_bits(walls.deformed.y, from.y);
}

Mesh hybrid_airfoil(double first = 1e-4) {
    Naca4 naca;
    naca.camber = 0.02;
    HybridOptions options;
    options.first = first;
    options.layers = 20;
    options.radius = 10;
    return hybrid_mesh(naca4(naca, 80), options);
}

}  // namespace

TEST_CASE("heights of the first layers return to a percent, and far points stay") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Mesh mesh = annulus(60, 120, 1, 3, kind, true);
        for (std::size_t k = 0; k < mesh.x.size();
             ++k) {  // rings closer at the wall: the first at 3e-4
            double const r = std::hypot(mesh.x[k], mesh.y[k]), t = std::log(r) / std::log(3.0);
            double const wanted = 1 + 2 * (std::exp(6.5 * t) - 1) / (std::exp(6.5) - 1);
            mesh.x[k] *= wanted / r;
            mesh.y[k] *= wanted / r;
        }
        Walls walls(mesh);
        walls.deform(Quadratic{0.12});
        Mesh const before = walls.deformed;
        REQUIRE(check(before).min_corner > 0);
        FirstLayerChange const lost = walls.change();
        CHECK(lost.min_ratio < 0.77);
        CHECK(lost.max_ratio > 1.23);
        walls.restore();
        FirstLayerChange const back = walls.change();
        CHECK(back.min_ratio > 0.99);
        CHECK(back.max_ratio < 1.01);
        CHECK(std::fabs(back.mean_ratio - 1) < 1e-3);
        CHECK(back.largest_angle < 2 * lost.largest_angle + 0.5);
        CHECK(check(walls.deformed).min_corner > 0);
        for (Index k = 0; k < mesh.n_points(); ++k) {
            Point const p = mesh.point(k);
            double const height = std::hypot(p.x, p.y) - 1;
            if (height < 1e-12 || height > 0.5)
                CHECK(moved(walls, before, k) == 0);  // a quarter of the extent
        }
    }
}

TEST_CASE("without motion no bit changes, and after rigid motion only rounding") {
    Walls walls(hybrid_airfoil());
    Mesh before = walls.deformed;
    walls.restore();
    CHECK(is_still(walls, before));
    walls.deform([](Point p) { return Point{0.6 * p.x - 0.8 * p.y + 1, 0.8 * p.x + 0.6 * p.y}; });
    before = walls.deformed;
    walls.restore();
    for (Index k = 0; k < before.n_points(); ++k) CHECK(moved(walls, before, k) < 1e-14);

    walls.deform([](Point p) { return Point{1.5 * p.x, 1.5 * p.y}; });
    before = walls.deformed;
    walls.restore(0);
    CHECK(is_still(walls, before));
    walls.restore(0.5);
    CHECK(walls.change().mean_ratio == doctest::Approx(1.25).epsilon(0.01));
    walls.deformed = before;
    walls.restore();
    CHECK(walls.change().mean_ratio == doctest::Approx(1).epsilon(0.01));
    CHECK(walls.change().mean_angle < 1);  // edges that slant do so with 1.5 times the slope
    CHECK(check(walls.deformed).min_corner > 0);
}

TEST_CASE("heights keep their order as long as the wall is stretched by more than 0.22") {
    Walls walls(annulus(200, 24, 1, 2));
    for (double const stretch : {0.25, 5.0, 0.15}) {
        walls.deform([&](Point p) { return Point{stretch * p.x, stretch * p.y}; });
        walls.restore();
        CHECK((check(walls.deformed).min_corner > 0) == (stretch > 0.22));
    }
}

TEST_CASE("heights return round an airfoil with a sharp trailing edge, and no cell is inverted") {
    for (double const first : {1e-5, 1e-3})
        for (double const a : {0.001, -0.001}) {
            Walls walls(hybrid_airfoil(first));
            std::complex<double> const inside(
                0.3, 0.008);  // z + a / (z - inside) is conformal outside of the airfoil
            walls.deform([&](Point p) {
                std::complex<double> const z(p.x, p.y), w = z + a / (z - inside);
                return Point{w.real(), w.imag()};
            });
            REQUIRE(check(walls.deformed).min_corner > 0);
            FirstLayerChange const lost = walls.change();
            CHECK((lost.min_ratio < 0.7 || lost.max_ratio > 1.4));
            walls.restore();
            FirstLayerChange const back = walls.change();
            CHECK(check(walls.deformed).min_corner > 0);
            double const left = first < 1e-4 ? 2e-3 : 2e-2;  // the fade loses 3 d / reach
            CHECK(back.min_ratio > 1 - left);
            CHECK(back.max_ratio < 1 + left);
            CHECK(back.mean_angle < lost.mean_angle + 0.05);
            CHECK(back.largest_angle < 2 * lost.largest_angle);
        }
}

TEST_CASE("joined points move together") {
    int const n_t = 48, n_r = 20;
    Mesh mesh = annulus(n_r, n_t, 1, 2);
    int const first_copy = mesh.n_points();
    for (int ring = 0; ring <= n_r; ++ring) mesh.add_point(mesh.point(ring * n_t));
    auto const cut = [&](std::int32_t& point) {
        point = point % n_t == 0 ? first_copy + point / n_t : point;
    };
    for (std::size_t k = 0; k < mesh.cells.size();
         ++k)  // the last column: beyond the cut the points are others
        if (int(k / 4) % n_t == n_t - 1) cut(mesh.cells[k]);
    for (std::size_t k = 0; k < mesh.faces.size(); ++k)
        if (mesh.faces[k ^ 1] % n_t == n_t - 1) cut(mesh.faces[k]);
    Walls walls(mesh);
    walls.deform(Quadratic{0.1});
    Mesh const before = walls.deformed;
    walls.restore();
    for (int ring = 0; ring <= n_r; ++ring) {
        CHECK(walls.analysed->topology().representative[first_copy + ring] == ring * n_t);
        CHECK(distance(walls.deformed.point(first_copy + ring), walls.deformed.point(ring * n_t)) ==
              0);
    }
    CHECK(moved(walls, before, n_t) > 0);
}

TEST_CASE("the reach is within the radius of curvature and a quarter of the extent") {
    Walls walls(hybrid_airfoil());
    walls.restore();
    harmorph::WallPoints const& wall = walls.heights.wall;
    double largest = 0;
    for (Index slot = 0; slot < wall.count; ++slot) {
        Point const here = walls.mesh.point(wall.point[slot]);
        // 1.1019 * 0.12^2 at the nose
        if (std::hypot(here.x, here.y) < 0.002) CHECK(walls.heights.reach[slot] < 0.018);
        if (here.x == 1) CHECK(walls.heights.reach[slot] < 0.01);  // the sharp edge
        largest = std::fmax(largest, walls.heights.reach[slot]);
        Index const next = wall.slot[wall.next[slot]];
        double const step = std::fabs(walls.heights.reach[next] - walls.heights.reach[slot]);
        CHECK(step <= 0.5 * distance(here, walls.mesh.point(wall.next[slot])) + 1e-15);
    }
    CHECK(largest > 0.1);
    CHECK(largest <= 0.25);

    Mesh mesh = square(8, Cells::quads);
    for (std::size_t k = 0; k < mesh.face_markers.size(); ++k)
        if (mesh.point(mesh.faces[2 * k]).y == 0 && mesh.point(mesh.faces[2 * k + 1]).y == 0)
            mesh.face_markers[k] = body;
    Walls open(mesh);
    open.restore();
    for (Index slot = 0; slot < open.heights.wall.count; ++slot) {
        double const x = mesh.point(open.heights.wall.point[slot]).x;
        if (x == 0 || x == 1) CHECK(open.heights.reach[slot] == 0);
        if (x == 0.5) CHECK(open.heights.reach[slot] > 0.1);
    }
}

TEST_CASE("points beside a boundary that is no wall do not move") {
    Mesh mesh = two_bodies(16, 12, {0.4, 0.3, 0}, {0.45, 0.35, 0.1});
    for (std::int32_t& marker : mesh.face_markers)
        marker = marker == second_body ? std::int32_t{9} : marker;
    std::vector<char> is_fixed(mesh.x.size(), 0);
    for (std::size_t k = 0; k < mesh.faces.size(); ++k)
        if (mesh.face_markers[k / 2] != body) is_fixed[std::size_t(mesh.faces[k])] = 1;
    Walls walls(mesh);
    walls.deform([](Point p) { return Point{1.2 * p.x, 1.2 * p.y}; });
    Mesh const before = walls.deformed;
    walls.restore();
    CHECK(!is_still(walls, before));
    for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
        std::int32_t const next = mesh.cells[k % 4 == 3 ? k - 3 : k + 1];  // all cells are quads
        if (is_fixed[std::size_t(next)]) CHECK(moved(walls, before, mesh.cells[k]) == 0);
    }
}

TEST_CASE("points whose nearest body does not change do not move, and cells stay valid") {
    Mesh const mesh = two_bodies(16, 12, {0.4, 0.3, 0},
                                 {0.4, 0.35, 0.2});  // gap 0.2, much less than their extent
    Walls walls(mesh);
    walls.deform([](Point p) { return Point{1 + (p.x < 1 ? 0.7 : 1.4) * (p.x - 1), p.y}; });
    Mesh const before = walls.deformed;
    REQUIRE(check(before).min_corner > 0);
    FirstLayerChange const lost = walls.change();
    walls.restore();
    CHECK(check(walls.deformed).min_corner > 0);
    int still = 0;
    for (Index k = 0; k < mesh.n_points(); ++k) {
        if (std::fabs(mesh.point(k).x - 1) > 1e-12) continue;  // the middle line of the gap
        CHECK(moved(walls, before, k) < 1e-3);
        ++still;
    }
    CHECK(still > 10);
    FirstLayerChange const change = walls.change();
    CHECK(1 - change.min_ratio < 0.3 * (1 - lost.min_ratio));
    CHECK(change.max_ratio - 1 < 0.3 * (lost.max_ratio - 1));
}

TEST_CASE("the number of threads changes no bit of wall heights") {
    Walls walls(hybrid_airfoil());
    walls.deform(Quadratic{0.02});
    Mesh const before = walls.deformed;
    walls.restore();
    Mesh const expected = walls.deformed;
    CHECK(!is_still(walls, before));
    Backwards backwards;
    for (std::int32_t const threads : {2, 7}) {
        walls.deformed = before;
        walls.restore(1, {Backwards::run, &backwards, threads});
        CHECK(is_still(walls, expected));
    }
    CHECK(backwards.tasks > 2);
}
