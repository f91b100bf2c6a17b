// Control volumes: they fill the domain, and close.
#include <fixtures/schemes.hpp>

using namespace fixtures;
using harmorph::Index;

namespace {

constexpr Cells kinds[] = {Cells::quads, Cells::triangles, Cells::hybrid};

// Largest length of the sum of what bounds a volume, boundary edges included.
double open_by(Scheme const& scheme, Mesh const& mesh) {
    std::vector<Point> sum(mesh.x.size(), Point{0, 0});
    auto const add = [&](Index point, double x, double y) {
        Point& sum_here = sum[std::size_t(scheme.seen->topology().representative[point])];
        sum_here = {sum_here.x + x, sum_here.y + y};
    };
    for (harmorph::MedianDual::Face const& face : scheme.operation.dual.faces) {
        add(face.begin, face.normal.x, face.normal.y);
        add(face.end, -face.normal.x, -face.normal.y);
    }
    for_each_half_face(mesh,
                       [&](std::int32_t point, Point normal) { add(point, normal.x, normal.y); });
    double out = 0;
    for (Point const p : sum) out = std::fmax(out, std::hypot(p.x, p.y));
    return out;
}

}  // namespace

TEST_CASE("dual volumes fill the domain and close, in whatever sense cells run") {
    for (Cells const kind : kinds) {
        Mesh const bodies = two_bodies(5, 4, Ellipse{}, Ellipse{}, kind);
        for (Mesh mesh : {square(7, kind, 3, 1), annulus(5, 16, 0.5, 2, kind), bodies}) {
            perturb(mesh, 0.3, 2);
            MeshCheck const expected = check(mesh);
            Scheme const plain(mesh, false);
            reverse_some(mesh, 3);
            Scheme const scheme(mesh, false);
            double area = 0;
            for (Index point = 0; point < mesh.n_points(); ++point) {
                double const volume = scheme.area[std::size_t(point)];
                CHECK(volume > 0);
                CHECK(volume == doctest::Approx(plain.area[std::size_t(point)]).epsilon(1e-12));
                area += volume;
            }
            CHECK(area == doctest::Approx(expected.area).epsilon(1e-13));
            CHECK(open_by(scheme, mesh) < 1e-14);
        }
    }
}

TEST_CASE("dual volumes of a triangle are thirds, and faces on squares are as long as cells") {
    Mesh one;
    one.add_point({0, 0});
    one.add_point({3, 0.5});
    one.add_point({-1, 2});
    one.add_cell({0, 1, 2});
    for (std::int32_t k = 0; k < 3; ++k) one.add_face(k, (k + 1) % 3, body);
    Scheme const triangle(one, false);
    double const third = check(one).area / 3;
    for (Index point = 0; point < 3; ++point)
        CHECK(triangle.area[std::size_t(point)] == doctest::Approx(third));

    Mesh const mesh = square(6);
    Scheme const squares(mesh, false);
    for (harmorph::MedianDual::Face const& face : squares.operation.dual.faces) {
        Point const a = mesh.point(face.begin), b = mesh.point(face.end);
        bool const horizontal = a.y == b.y;
        double const across = horizontal ? a.y : a.x;
        double const length =
            across == 0 || across == 1 ? 0.5 / 6 : 1.0 / 6;  // half a cell along the boundary
        CHECK((horizontal ? face.normal.x : face.normal.y) ==
              doctest::Approx(length).epsilon(1e-13));
        CHECK(std::fabs(horizontal ? face.normal.y : face.normal.x) < 1e-15);
    }
}

TEST_CASE("the points of a cut have one volume") {
    CMesh const c = c_mesh(naca4({}, 20), 10, 6, stretched(1e-2, 6, 10));
    Scheme const scheme(c.mesh, false);
    double area = 0;
    int joined = 0;
    for (Index point = 0; point < c.mesh.n_points(); ++point) {
        bool const is_joined = scheme.seen->topology().representative[point] != point;
        CHECK((scheme.area[std::size_t(point)] == 0) == is_joined);
        joined += is_joined;
        area += scheme.area[std::size_t(point)];
    }
    CHECK(joined == c.n_wake + 1);  // one for each point of the wake, the trailing edge among them
    CHECK(area == doctest::Approx(check(c.mesh).area).epsilon(1e-12));
    CHECK(open_by(scheme, c.mesh) < 1e-13);
}
