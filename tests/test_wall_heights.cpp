// Heights above the walls brought back after conformal maps, whose stretch is known; and what must stay as it is.
#include <doctest/doctest.h>

#include <fixtures/airfoil.hpp>
#include <fixtures/c_mesh.hpp>
#include <fixtures/check.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/walls.hpp>

#include <complex>

using namespace fixtures;
using harmorph::FirstLayerChange;
using harmorph::Index;

namespace {

// z + a z^2: angles are kept, lengths are scaled by |1 + 2 a z|.
struct Quadratic {
    double a;
    Point operator()(Point p) const { return {p.x + a * (p.x * p.x - p.y * p.y), p.y + 2 * a * p.x * p.y}; }
};

double moved(Walls const& walls, Mesh const& from, Index k) { return distance(walls.deformed.point(k), from.point(k)); }

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

TEST_CASE("heights of the first layers come back to a percent; angles, walls and far points stay") {
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Mesh mesh = annulus(60, 120, 1, 3, kind, true);
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {   // rings closer at the wall: the first at 3e-4
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
        CHECK((lost.min_ratio < 0.77 && lost.max_ratio > 1.23));
        walls.restore();
        FirstLayerChange const back = walls.change();
        CHECK(back.min_ratio > 0.99);
        CHECK(back.max_ratio < 1.01);
        CHECK(std::fabs(back.mean_ratio - 1) < 1e-3);
        CHECK(back.largest_angle < 2 * lost.largest_angle + 0.5);
        CHECK(check(walls.deformed).min_corner > 0);
        for (Index k = 0; k < mesh.n_points(); ++k) {
            double const height = std::hypot(mesh.x[static_cast<std::size_t>(k)], mesh.y[static_cast<std::size_t>(k)]) - 1;
            if (height < 1e-12 || height > 0.5) CHECK(moved(walls, before, k) == 0);   // a quarter of the extent
        }
    }
}

TEST_CASE("no motion is left alone to the last bit, rigid motion to rounding; scaling is undone near the wall") {
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
    CHECK(walls.change().mean_angle < 1);   // edges that slant do so with 1.5 times the slope
    CHECK(check(walls.deformed).min_corner > 0);
}

TEST_CASE("a viscous airfoil mesh: heights come back, sharp edge and all, and no cell inverts") {
    for (double const first : {1e-5, 1e-3})
        for (double const a : {0.001, -0.001}) {
            Walls walls(hybrid_airfoil(first));
            std::complex<double> const inside(0.3, 0.008);   // z + a / (z - inside) is conformal outside of the airfoil
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
            double const left = first < 1e-4 ? 2e-3 : 2e-2;   // the fade loses 3 d / reach
            CHECK(back.min_ratio > 1 - left);
            CHECK(back.max_ratio < 1 + left);
            CHECK(back.mean_angle < lost.mean_angle + 0.05);
            CHECK(back.largest_angle < 2 * lost.largest_angle);
        }
}

TEST_CASE("joined points move together") {
    Naca4 naca;
    CMesh const c = c_mesh(naca4(naca, 40), 12, 3, stretched(1e-3, 5, 30));
    Walls walls(c.mesh);
    walls.deform(Quadratic{0.05});
    Mesh const before = walls.deformed;
    walls.restore();
    int joined = 0;
    for (Index k = 0; k < c.mesh.n_points(); ++k) {
        Index const its = walls.analysed->representative[k];
        joined += its != k;
        CHECK(distance(walls.deformed.point(k), walls.deformed.point(its)) == 0);
    }
    CHECK(joined > 0);
    CHECK(!is_still(walls, before));
}

TEST_CASE("two bodies: where the nearest changes nothing moves, and cells stay valid") {
    Mesh const mesh = two_bodies(16, 12, {0.4, 0.3, 0}, {0.4, 0.35, 0.2});   // gap 0.2, much less than their extent
    Walls walls(mesh);
    walls.deform([](Point p) {
        return Point{1 + (p.x < 1 ? 0.7 : 1.4) * (p.x - 1), p.y};
    });
    Mesh const before = walls.deformed;
    REQUIRE(check(before).min_corner > 0);
    FirstLayerChange const lost = walls.change();
    walls.restore();
    CHECK(check(walls.deformed).min_corner > 0);
    int still = 0;
    for (Index k = 0; k < mesh.n_points(); ++k) {
        if (std::fabs(mesh.point(k).x - 1) > 1e-12) continue;   // the middle line of the gap
        CHECK(moved(walls, before, k) < 1e-3);
        ++still;
    }
    CHECK(still > 10);
    FirstLayerChange const change = walls.change();
    CHECK(1 - change.min_ratio < 0.3 * (1 - lost.min_ratio));
    CHECK(change.max_ratio - 1 < 0.3 * (lost.max_ratio - 1));
}

TEST_CASE("any number of threads, the same bits") {
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
