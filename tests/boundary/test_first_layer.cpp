// The first layer: which edges leave the wall, and what deformations with known derivatives do to
// angles and heights.
#include <fixtures/core.hpp>

#include "base/vec2.hpp"

using namespace fixtures;
using harmorph::FirstLayerChange;
using harmorph::Index;

namespace {

Point turned(Point p, double angle, double scale) {
    double const c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

}  // namespace

TEST_CASE("the first layer follows the column in quads, and in triangles the normal") {
    Walls const quads(annulus(4, 30, 1, 1.5));
    CHECK(quads.layer.wall.count == 30);
    for (Index slot = 0; slot < 30; ++slot)
        CHECK(quads.layer.above[slot] == quads.layer.wall.point[slot] + 30);

    Mesh const mesh = annulus(4, 30, 1, 1.5, Cells::triangles);
    Walls const walls(mesh);
    for (Index slot = 0; slot < 30; ++slot) {
        Index const foot = walls.layer.wall.point[slot];
        double best = 0, seen = 0;
        for (std::size_t k = 0; k < mesh.cells.size(); k += 3)
            for (std::size_t i = 0; i < 9; ++i) {
                Index const a = mesh.cells[k + i / 3], b = mesh.cells[k + i % 3];
                if (a != foot || b < 30) continue;
                Point const p = mesh.point(a), q = mesh.point(b);
                double const cosine =
                    ((q.x - p.x) * p.x + (q.y - p.y) * p.y) / fixtures::distance(p, q);  // radius 1
                best = std::fmax(best, cosine);
                if (b == walls.layer.above[slot]) seen = cosine;
            }
        CHECK(seen > 0.5);
        CHECK(seen == doctest::Approx(best).epsilon(1e-14));
    }
}

TEST_CASE("rigid motion and scaling change no angle, and heights scale") {
    Naca4 naca;
    naca.camber = 0.03;
    Walls walls(hybrid_mesh(naca4(naca, 60), HybridOptions{}));
    FirstLayerChange const still = walls.change();
    CHECK(still.points == 120);
    CHECK(still.mean_angle == 0);
    CHECK(still.largest_angle == 0);
    for (Index const point :
         {still.largest_angle_point, still.min_ratio_point, still.max_ratio_point})
        CHECK(point == walls.layer.wall.point[0]);  // all are equal: the first one
    CHECK(still.min_ratio == 1);
    CHECK(still.max_ratio == 1);
    CHECK(still.mean_ratio == 1);
    for (double const scale : {1.0, 2.5}) {
        walls.deform([&](Point p) { return turned({p.x + 3, p.y - 1}, 2, scale); });
        FirstLayerChange const seen = walls.change();
        CHECK(seen.largest_angle < 1e-9);
        CHECK(seen.min_ratio == doctest::Approx(scale).epsilon(1e-11));
        CHECK(seen.max_ratio == doctest::Approx(scale).epsilon(1e-11));
    }
}

TEST_CASE("shear of a flat wall gives the known angle and point, also where walls end") {
    Mesh mesh = square(8, Cells::quads);  // all of its boundary is the far field
    for (std::size_t k = 0; k < mesh.face_markers.size(); ++k)
        if (mesh.point(mesh.faces[2 * k]).y == 0 && mesh.point(mesh.faces[2 * k + 1]).y == 0)
            mesh.face_markers[k] = body;
    Walls walls(mesh);
    CHECK(walls.layer.wall.count == 9);
    walls.deform([](Point p) { return Point{p.x + 0.3 * p.y, 2 * p.y}; });
    FirstLayerChange const sheared = walls.change();
    CHECK(sheared.points == 9);
    CHECK(sheared.mean_angle ==
          doctest::Approx(harmorph::in_degrees(std::atan(0.15))).epsilon(1e-13));
    CHECK(sheared.largest_angle == doctest::Approx(sheared.mean_angle).epsilon(1e-13));
    CHECK(sheared.mean_ratio == doctest::Approx(2));

    walls.deform([](Point p) { return p.x == 0.25 && p.y == 0.125 ? Point{0.3, 0.05} : p; });
    FirstLayerChange const one = walls.change();
    CHECK(one.largest_angle_point == one.min_ratio_point);
    CHECK(mesh.point(one.min_ratio_point).x == 0.25);
    CHECK(one.min_ratio == doctest::Approx(0.4));
    CHECK(one.max_ratio == 1);
    CHECK(one.largest_angle == doctest::Approx(45));
    CHECK(one.mean_angle == doctest::Approx(45.0 / 9));
}

TEST_CASE("a conformal map keeps angles and scales heights with the wall to first order") {
    double last[2] = {1, 1};
    for (int const n : {60, 120, 240}) {
        Walls walls(annulus(8, n, 1, 1 + 8.0 / n));
        double const a = 0.1;
        walls.deform([&](Point p) {
            return Point{p.x + a * (p.x * p.x - p.y * p.y), p.y + 2 * a * p.x * p.y};
        });
        FirstLayerChange const seen = walls.change();
        double const low = std::fabs(seen.min_ratio - (1 - 2 * a)),
                     high = std::fabs(seen.max_ratio - (1 + 2 * a));
        double const error[2] = {seen.largest_angle, std::fmax(low, high)};
        if (n == 240) CHECK(error[0] < 0.5);  // degrees, at the end of an edge 1/240 long
        for (int k = 0; k < 2; ++k) CHECK(error[k] < 0.6 * last[k] * (n == 60 ? 100 : 1));
        for (int k = 0; k < 2; ++k) last[k] = error[k];
        CHECK(walls.mesh.point(seen.max_ratio_point).x == doctest::Approx(1));
        CHECK(walls.mesh.point(seen.min_ratio_point).x == doctest::Approx(-1));
    }
}

TEST_CASE("the turn of a wall is of second order also where faces have uneven lengths") {
    double last = 0;
    for (int const n : {40, 80, 160}) {
        Mesh mesh = annulus(1, n, 1, 1 + 1e-6);  // so low that only the wall's turn is left
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {
            double const angle = 2 * pi * (int(k) % n + (k % 2 == 0 ? 0.0 : 0.5)) / n;
            double const r = std::hypot(mesh.x[k], mesh.y[k]);
            mesh.x[k] = r * std::cos(angle);
            mesh.y[k] = r * std::sin(angle);
        }
        Walls walls(mesh);
        walls.deform([](Point p) {
            return Point{p.x + 0.1 * (p.x * p.x - p.y * p.y), p.y + 0.2 * p.x * p.y};
        });
        double const error = walls.change().largest_angle;
        if (last > 0) CHECK(error < 0.3 * last);
        last = error;
    }
}
