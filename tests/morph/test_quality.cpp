// Quality of cells whose quality is known.
#include <harmorph_study.h>
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/traps.hpp>

#include "morph/quality.hpp"

using namespace fixtures;
using harmorph::Quality;

namespace {

double skew(std::vector<Point> const& corners, bool reversed = false) {
    std::vector<double> xy;
    harmorph::Cell cell;
    for (Point const p : corners) {
        xy.insert(xy.end(), {p.x, p.y});
        cell.point[cell.n] = cell.n;
        ++cell.n;
    }
    harmorph::CellShape const shape(cell, {xy.data(), xy.data() + 1, 2}, reversed);
    harmorph::Fraction const quality = skew_fraction(cell.n, harmorph::CellCorners(shape));
    return quality.numerator / quality.denominator;
}

Quality measure(Mesh const& mesh, Mesh const* reference = nullptr, bool reversed = false) {
    harmorph::Mesh const view = core_mesh(mesh);
    harmorph::Points const ref = reference ? core_mesh(*reference).points : harmorph::Points{};
    std::vector<std::uint8_t> all(std::size_t(mesh.n_cells()), reversed ? 1 : 0);
    return measure_quality({view, span(all)}, view.points, ref, {});
}

double const root3 = std::sqrt(3.0);

}  // namespace

TEST_CASE("triangles: 1 if equilateral, known values otherwise, 0 if flat or inverted") {
    CHECK(skew({{0, 0}, {1, 0}, {0.5, 0.5 * root3}}) == doctest::Approx(1).epsilon(1e-15));
    CHECK(skew({{0, 0}, {1, 0}, {0, 1}}) ==
          doctest::Approx(0.5 * root3));  // 2 sqrt(3) 2A / (sum of squared sides)
    for (double const h : {0.01, 0.3, 1.0, 5.0}) {
        double const sides = 1 + 2 * (0.25 + h * h);
        CHECK(skew({{0, 0}, {1, 0}, {0.5, h}}) == doctest::Approx(2 * root3 * h / sides));
    }
    CHECK(skew({{0, 0}, {1, 0}, {2, 0}}) == 0);
    CHECK(skew({{0, 0}, {0, 1}, {1, 0}}) == 0);
    CHECK(skew({{0, 0}, {0, 1}, {1, 0}}, true) == doctest::Approx(0.5 * root3));
    CHECK(skew({{0, 0}, {1, 0}, {0, 1}}, true) == 0);
}

TEST_CASE("quads: 1 for every rectangle, the sine of a parallelogram's angle, 0 if not convex") {
    for (double const a : {1.0, 1e-4, 1e4})
        CHECK(skew({{0, 0}, {a, 0}, {a, 1}, {0, 1}}) == doctest::Approx(1).epsilon(1e-14));
    for (double const angle : {0.1, 0.7, 1.5, 3.0})
        for (double const length : {0.01, 1.0, 30.0}) {
            Point const up{length * std::cos(angle), length * std::sin(angle)};
            CHECK(skew({{0, 0}, {1, 0}, {1 + up.x, up.y}, up}) ==
                  doctest::Approx(std::sin(angle)).epsilon(1e-12));
        }
    CHECK(skew({{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}}) == 0);  // an arrow head
    CHECK(skew({{0, 0}, {1, 1}, {1, 0}, {0, 1}}) == 0);      // folded
    CHECK(skew({{0, 0}, {0, 1}, {1, 1}, {1, 0}}) == 0);      // clockwise
    CHECK(skew({{0, 0}, {0, 1}, {1, 1}, {1, 0}}, true) == 1);
}

TEST_CASE("neither size, place, angle nor the first corner matters") {
    std::vector<Point> const quad = {{0.1, 0}, {1.3, -0.2}, {1, 0.9}, {-0.1, 0.7}},
                             triangle = {{0, 0}, {2, 0.1}, {0.4, 0.9}};
    for (std::vector<Point> const& shape : {quad, triangle}) {
        double const expected = skew(shape);
        CHECK(expected > 0.2);
        CHECK(expected < 1);
        for (double const scale : {1e-9, 1e-3, 1e6}) {
            std::vector<Point> other;
            double const c = scale * std::cos(1.1), s = scale * std::sin(1.1);
            for (Point const p : shape) other.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
            std::rotate(other.begin(), other.begin() + 1, other.end());
            CHECK(skew(other) == doctest::Approx(expected).epsilon(1e-13));
        }
    }
}

TEST_CASE("cells that grow or shrink lose the square root of the ratio of areas in quality") {
    Mesh const reference = square(6, Cells::quads, 2, 2);
    Mesh mesh = reference;
    for (double const factor : {0.5, 2.0, 10.0}) {
        for (std::size_t k = 0; k < mesh.x.size(); ++k) {
            mesh.x[k] = factor * reference.x[k];
            mesh.y[k] = factor * reference.y[k];
        }
        double const expected = factor > 1 ? 1 / factor : factor;  // sqrt(1 / factor^2)
        Quality const seen = measure(mesh, &reference);
        CHECK(seen.mean_quality() == doctest::Approx(expected).epsilon(1e-12));
        CHECK(seen.min_quality == doctest::Approx(expected).epsilon(1e-12));
        CHECK(measure(mesh).mean_quality() == doctest::Approx(1).epsilon(1e-12));
    }
    CHECK(measure(reference, &reference).min_quality == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("inverted cells are counted, the first is named, and they count 0 in the mean") {
    Mesh mesh = square(6, Cells::quads);  // 36 unit squares, scaled
    Quality seen = measure(mesh);
    CHECK(seen.inverted == 0);
    CHECK(seen.first_inverted == -1);
    CHECK(seen.min_area == doctest::Approx(0.5 / 36));
    CHECK(seen.mean_quality() == doctest::Approx(1));
    mesh.x[16] = mesh.y[16] = -10;  // point (2, 2)
    std::int32_t inverted = 0, first = -1;
    double sum = 0, least = 1;
    for (std::int32_t i = 0; i < mesh.n_cells(); ++i) {
        std::vector<Point> corners;
        for (std::size_t k = 0; k < 4; ++k)
            corners.push_back(mesh.point(mesh.cells[4 * std::size_t(i) + k]));
        bool bad = false;
        for (std::size_t k = 0; k < 4; ++k) {
            double const area =
                0.5 * twice_area(corners[k], corners[(k + 1) % 4], corners[(k + 3) % 4]);
            least = std::fmin(least, area);
            bad = bad || area <= 0;
        }
        if (bad && inverted++ == 0) first = i;
        if (!bad) sum += skew(corners);
    }
    seen = measure(mesh);
    CHECK(inverted >= 2);
    CHECK(first == 7);
    CHECK(seen.inverted == inverted);
    CHECK(seen.first_inverted == first);
    CHECK(seen.min_area == least);
    CHECK(seen.min_quality == 0);
    CHECK(seen.min_quality_cell == first);
    CHECK(seen.mean_quality() == doctest::Approx(sum / 36));

    Mesh flat = square(2, Cells::triangles);
    flat.x[4] = flat.x[3];  // the middle onto the left side: empty cells are inverted ones
    CHECK(measure(flat).inverted >= 1);
    CHECK(measure(flat).min_area <= 0);
}

TEST_CASE("clockwise meshes are as good as counter-clockwise ones") {
    Mesh mesh = annulus(5, 24, 0.5, 2, Cells::hybrid);
    perturb(mesh, 0.3, 1);
    Quality const expected = measure(mesh);
    reverse_all(mesh);
    CHECK(measure(mesh).inverted == mesh.n_cells());
    Quality const seen = measure(mesh, nullptr, true);
    CHECK(seen.inverted == 0);
    CHECK(seen.min_quality == doctest::Approx(expected.min_quality).epsilon(1e-13));
    CHECK(seen.mean_quality() == doctest::Approx(expected.mean_quality()).epsilon(1e-13));
    CHECK(seen.min_area == doctest::Approx(expected.min_area).epsilon(1e-13));
    CHECK(seen.min_quality_cell == expected.min_quality_cell);
}

TEST_CASE("a coordinate that is not finite makes its cells invalid, whichever corner it is") {
    Untrapped const untrapped;
    for (double const bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        for (std::int32_t corner = 0; corner < 49; ++corner) {
            Mesh mesh = square(6, Cells::hybrid);
            perturb(
                mesh, 0.2,
                3);  // no side parallel to an axis: 0 times infinity is not what makes areas NaN
            mesh.x[std::size_t(corner)] = bad;
            Quality const seen = measure(mesh);
            std::int32_t cells = 0;
            for (std::int32_t const point : mesh.cells) cells += point == corner;
            CHECK(seen.inverted == cells);
            CHECK(seen.min_quality == 0);
            CHECK(seen.min_area == -HUGE_VAL);
            CHECK(seen.mean_quality() > 0);
            CHECK(seen.mean_quality() < 1);
        }
    }
}

TEST_CASE("an infinite area counts beside a finite one that is negative") {
    Untrapped const untrapped;
    Mesh mesh = square(3, Cells::quads);
    double const x[] = {0, 1, 2.1, 0.2},
                 y[] = {0, 1, 1.3, HUGE_VAL};  // three areas of +inf, the second one is -0.4
    for (std::size_t k = 0; k < 4; ++k) {
        std::size_t const point = std::size_t(mesh.cells[k]);
        mesh.x[point] = x[k];
        mesh.y[point] = y[k];
    }
    Quality const seen = measure(mesh);
    CHECK(seen.first_inverted == 0);
    CHECK(seen.min_area == -HUGE_VAL);
}

TEST_CASE("the report on a mesh says the same, in the caller's numbering") {
    Case setup = tiny_case();
    setup.index_base = 1;
    setup.mesh.x[8] = 0.1;  // thin, but valid
    Solved const solved(setup);
    auto report = sized<hm_mesh_report>();
    REQUIRE(hm_analysis_report(solved.analysis, &report, nullptr) == HM_OK);
    Quality const expected = measure(setup.mesh);
    CHECK(report.points == 48);
    CHECK(report.used_points == 48);
    CHECK(report.cells == 48);
    CHECK(report.quads == 16);
    CHECK(report.triangles == 32);
    CHECK(report.boundary_edges == 32);
    CHECK(report.boundary_loops == 2);
    CHECK(report.edges == 48 + 48);  // Euler: V - E + F = 0
    CHECK(report.min_area == expected.min_area);
    CHECK(report.min_quality == expected.min_quality);
    CHECK(report.mean_quality == expected.mean_quality());
    auto quality = sized<hm_quality_report>();
    hm_mesh const mesh = setup.mesh_view();
    REQUIRE(hm_assess(solved.basis, &mesh, &mesh.points, nullptr, &mesh.points, nullptr, nullptr,
                      &quality, nullptr) == HM_OK);
    CHECK(quality.mean_quality == doctest::Approx(expected.mean_quality()).epsilon(1e-15));
    CHECK(quality.min_quality_cell == expected.min_quality_cell + 1);
}
