// Classical harmonic coordinates: a cage of degree 1 round the whole mesh, and positions instead of displacements. (Joshi,
// Meyer, DeRose, Green, Sanocki, ACM Trans. Graph. 26 (2007) 71.)
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>

using namespace fixtures;

namespace {

// An L of squares of length 1/n, lower left corner at 0, in a cage with a corner that is not convex; all points on it have
// their parameters. Points are perturbed inside.
struct Cage {
    Case its;
    std::vector<Point> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

    Cage(int n, Cells kind) {
        std::vector<std::int32_t> ids;
        int const side = 2 * n + 1;
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                ids.push_back(i > n && j > n ? -1 : its.mesh.add_point({1.0 * i / n, 1.0 * j / n}));
        auto const id = [&](int i, int j) { return ids[static_cast<std::size_t>(side * j + i)]; };
        for (int j = 0; j + 1 < side; ++j)
            for (int i = 0; i + 1 < side; ++i) {
                if (i >= n && j >= n) continue;
                bool const split = kind == Cells::triangles || (kind == Cells::hybrid && i < n);
                its.mesh.add_quad(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1), split);
            }
        for (std::size_t k = 0; k < corners.size(); ++k) {
            Point const a = corners[k], b = corners[(k + 1) % corners.size()];
            int const steps = static_cast<int>(n * distance(a, b) + 0.5);
            auto const at = [&](int s) {
                double const x = a.x + (b.x - a.x) * s / steps, y = a.y + (b.y - a.y) * s / steps;
                return id(static_cast<int>(n * x + 0.5), static_cast<int>(n * y + 0.5));
            };
            for (int s = 0; s < steps; ++s) {
                its.mesh.add_face(at(s), at(s + 1), body);
                its.give(at(s), static_cast<double>(k) + 1.0 * s / steps);
            }
        }
        perturb(its.mesh, 0.3, 4);
        its.curves = polyline(corners);
        its.put_on_curves(body);
    }
};

hm_options of_scheme(std::int32_t scheme) {
    hm_options out = laplace();
    out.scheme = scheme;
    return out;
}

}  // namespace

TEST_CASE("affine maps of the cage are reproduced inside, also where it is not convex") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
        for (std::int32_t const scheme : {HM_COMPACT, HM_BOUNDED}) {
            Cage cage(6, kind);
            hm_options const options = of_scheme(scheme);
            Solved const solved(cage.its, &options);
            for (double const sum : solved.sum()) CHECK(std::fabs(sum - 1) < 1e-13);
            std::vector<double> x, y, mapped;
            for (Point const p : cage.corners) {
                x.push_back(p.x);
                y.push_back(p.y);
                mapped.push_back(3 - 2 * p.x + 0.5 * p.y);
            }
            CHECK(largest_difference(solved.combined(x), cage.its.mesh.x) < 1e-13);
            CHECK(largest_difference(solved.combined(y), cage.its.mesh.y) < 1e-13);
            std::vector<double> expected;
            for (std::size_t k = 0; k < cage.its.mesh.x.size(); ++k) {
                expected.push_back(3 - 2 * cage.its.mesh.x[k] + 0.5 * cage.its.mesh.y[k]);
            }
            CHECK(largest_difference(solved.combined(mapped), expected) < 1e-13);
        }
}

TEST_CASE("coordinates are never negative, 1 at their corner alone, and linear along the cage") {
    Cage cage(6, Cells::hybrid);
    hm_options const options = of_scheme(HM_BOUNDED);
    Solved const solved(cage.its, &options);
    CHECK((solved.report.min_value >= 0 && solved.report.max_value == 1));
    for (std::int32_t function = 0; function < 6; ++function) {
        std::vector<double> const values = solved.values(function);
        int ones = 0;
        for (double const value : values) ones += value == 1;
        CHECK(ones == 1);
        for (std::size_t k = 0; k < cage.its.given_u.size(); ++k) {
            double const apart = std::fabs(cage.its.given_u[k] - function);
            double const hat = std::fmax(0, 1 - std::fmin(apart, 6 - apart));
            CHECK(values[static_cast<std::size_t>(cage.its.given_points[k])] == doctest::Approx(hat).epsilon(1e-14));
        }
    }
}
