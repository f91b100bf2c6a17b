// The conservative transfer between control volumes: common areas, integrals over the common area,
// linear fields, order of convergence, threads, refusals.
#include <harmorph_fields.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/naca0012.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/squares.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

using namespace fixtures;

namespace {

// The area and the mean position of the control volume of each point, by the cells of the mesh.
struct Volumes {
    std::vector<double> area, x, y;

    explicit Volumes(Mesh const& mesh)
        : area(mesh.x.size(), 0.0), x(mesh.x.size(), 0.0), y(mesh.x.size(), 0.0) {
        for (std::size_t i = 0; i + 1 < mesh.cell_start.size(); ++i) {
            std::vector<std::int32_t> cell(mesh.cells.begin() + mesh.cell_start[i],
                                           mesh.cells.begin() + mesh.cell_start[i + 1]);
            add_cell(mesh, cell);
        }
        for (std::size_t k = 0; k < area.size(); ++k) {
            x[k] /= area[k];
            y[k] /= area[k];
        }
    }

private:
    void add_cell(Mesh const& mesh, std::vector<std::int32_t> const& cell) {
        // Places are relative to the first corner, so that thin cells lose no digits.
        std::size_t const n = cell.size();
        Point const origin = mesh.point(cell[0]);
        std::vector<Point> at;
        Point centre{0, 0};
        for (std::int32_t const p : cell) {
            at.push_back({mesh.point(p).x - origin.x, mesh.point(p).y - origin.y});
            centre.x += at.back().x / static_cast<double>(n);
            centre.y += at.back().y / static_cast<double>(n);
        }
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t const other : {(k + 1) % n, (k + n - 1) % n}) {
                Point const middle{0.5 * (at[k].x + at[other].x), 0.5 * (at[k].y + at[other].y)};
                double const triangle = 0.5 * std::fabs(twice_area(at[k], middle, centre));
                std::size_t const p = static_cast<std::size_t>(cell[k]);
                area[p] += triangle;
                x[p] += triangle * (origin.x + (at[k].x + middle.x + centre.x) / 3);
                y[p] += triangle * (origin.y + (at[k].y + middle.y + centre.y) / 3);
            }
        }
    }
};

struct Remapped {
    hm_status status = HM_OK;
    std::vector<double> values, covered;
    hm_remap_report report;
    hm_error error;
};

Remapped remap(Mesh const& from, Mesh const& to, std::vector<double> const& values,
               std::int32_t order, std::int32_t n_fields = 1,
               const hm_executor* executor = nullptr) {
    Remapped found;
    Analysed const source(from), target(to);
    std::size_t bytes = 0;
    REQUIRE(hm_remap_size(source.analysis, target.analysis, n_fields, order, &bytes, nullptr) ==
            HM_OK);
    Guarded work(bytes, 0);
    found.values.assign(to.x.size() * static_cast<std::size_t>(n_fields), NAN);
    found.covered.assign(to.x.size(), NAN);
    HM_INIT(found.report);
    CHECK(hm_remap(source.analysis, nullptr, target.analysis, nullptr, n_fields, order,
                   values.data(), found.values.data(), found.covered.data(), work.data(), bytes - 1,
                   executor, nullptr, nullptr) == HM_BLOCK_TOO_SMALL);
    CHECK(std::isnan(found.covered[0]));
    found.status = hm_remap(source.analysis, nullptr, target.analysis, nullptr, n_fields, order,
                            values.data(), found.values.data(), found.covered.data(), work.data(),
                            bytes, executor, &found.report, &found.error);
    return found;
}

double dot(std::vector<double> const& a, std::vector<double> const& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double linear(double x, double y) { return 0.3 + 2 * x - 0.7 * y; }
double smooth(double x, double y) { return std::sin(2 * x + 0.3) * std::cos(1.5 * y); }

template <class Field>
std::vector<double> at_centroids(Volumes const& volumes, Field field) {
    std::vector<double> values;
    for (std::size_t k = 0; k < volumes.x.size(); ++k)
        values.push_back(field(volumes.x[k], volumes.y[k]));
    return values;
}

}  // namespace

TEST_CASE("meshes of one domain: volumes are covered, integrals stay, linear fields are exact") {
    // Each pair covers the same domain: squares of different cells, and one mesh with itself.
    Mesh const thin = naca0012_viscous(3000, 1e-6),
               two = two_bodies(40, 15, {}, {0.25, 0.06, 0.4}, Cells::hybrid);
    struct Pair {
        Mesh from, to;
    };
    std::vector<Pair> const pairs{{square_of(20, 1), square_of(17, 2)},
                                  {square_of(6, 0.4), square_of(45, 2)},
                                  {square_of(45, 2), square_of(6, 0.4)},
                                  {thin, thin},
                                  {two, two}};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        CAPTURE(k);
        Volumes const from(pairs[k].from), to(pairs[k].to);
        double const area = std::accumulate(from.area.begin(), from.area.end(), 0.0);
        std::vector<double> noise(from.area.size());
        for (double& each : noise) each = uniform(random);
        for (std::int32_t const order : {1, 2}) {
            CAPTURE(order);
            Remapped const found = remap(pairs[k].from, pairs[k].to, noise, order);
            REQUIRE(found.status == HM_OK);
            CHECK(found.report.uncovered == 0);
            CHECK(found.report.partial == 0);
            CHECK(std::fabs(found.report.area - area) < 1e-13 * area);
            CHECK(std::fabs(dot(found.values, to.area) - dot(noise, from.area)) < 1e-13 * area);
            double worst = 0;
            for (std::size_t i = 0; i < to.area.size(); ++i)
                worst = std::fmax(worst, std::fabs(found.covered[i] / to.area[i] - 1));
            CHECK(worst < 1e-11);
            if (order == 1) {
                CHECK(*std::max_element(found.values.begin(), found.values.end()) <=
                      *std::max_element(noise.begin(), noise.end()) + 1e-14);
            }
        }
        Remapped const plane = remap(pairs[k].from, pairs[k].to, at_centroids(from, linear), 2);
        std::vector<double> const exact = at_centroids(to, linear);
        double worst = 0, largest = 1;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            worst = std::fmax(worst, std::fabs(plane.values[i] - exact[i]));
            largest = std::fmax(largest, std::fabs(exact[i]));
        }
        CHECK(worst < 1e-13 * largest);
    }
}

TEST_CASE("domains that overlap in part: the integral over the common rectangle") {
    Mesh const from = square_of(19, 1);
    Mesh to = square_of(23, 2);
    for (double& x : to.x) x += 0.4;
    for (double& y : to.y) y -= 0.25;
    // The common area is [0.4, 1] x [0, 0.75].
    double const area = 0.6 * 0.75;
    Remapped const found = remap(from, to, at_centroids(Volumes(from), linear), 2);
    REQUIRE(found.status == HM_OK);
    CHECK(std::fabs(found.report.area - area) < 1e-13);
    CHECK(std::fabs(dot(found.values, found.covered) - area * linear(0.7, 0.375)) < 1e-13);
    int uncovered = 0, partial = 0;
    Volumes const volumes(to);
    for (std::size_t k = 0; k < found.covered.size(); ++k) {
        uncovered += found.covered[k] == 0;
        partial += found.covered[k] > 0 && found.covered[k] < 0.999999 * volumes.area[k];
        if (found.covered[k] == 0) CHECK(found.values[k] == 0);
    }
    CHECK(uncovered == found.report.uncovered);
    CHECK(partial == found.report.partial);
    CHECK(uncovered > 100);
    CHECK(partial > 10);
    for (double& x : to.x) x += 3;
    CHECK(remap(from, to, std::vector<double>(from.x.size(), 1.0), 1).report.uncovered ==
          static_cast<int>(to.x.size()));
}

TEST_CASE("polygons: a constant field stays on all volumes that are covered") {
    Mesh cells = honeycomb(12, 40, 1, 3);
    cells.cell_layout = HM_CELLS_POLYGONS;
    Remapped const found = remap(cells, cells, std::vector<double>(cells.x.size(), 2.5), 1);
    REQUIRE(found.status == HM_OK);
    CHECK(found.report.partial == 0);
    for (std::size_t k = 0; k < found.values.size(); ++k)
        CHECK(std::fabs(found.values[k] - 2.5) < 1e-14);
}

TEST_CASE("errors fall with the order that was asked for") {
    for (std::int32_t const order : {1, 2}) {
        CAPTURE(order);
        std::vector<double> error;
        for (int const n : {16, 32, 64}) {
            Mesh const from = square_of(n, 1), to = square_of(n + 3, 2);
            Remapped const found = remap(from, to, at_centroids(Volumes(from), smooth), order);
            std::vector<double> const exact = at_centroids(Volumes(to), smooth);
            double sum = 0;
            for (std::size_t k = 0; k < exact.size(); ++k)
                sum += std::fabs(found.values[k] - exact[k]);
            error.push_back(sum / static_cast<double>(exact.size()));
        }
        CHECK(std::log2(error[0] / error[1]) > order - 0.25);
        CHECK(std::log2(error[1] / error[2]) > order - 0.25);
    }
}

TEST_CASE("several fields at once and threads do not change the bits") {
    Mesh const from = naca0012_triangles(3000), to = naca0012_viscous(5000, 1e-5);
    Backwards threads;
    hm_executor const executor = threads.executor(4);
    std::size_t const n = from.x.size(), m = to.x.size();
    std::vector<double> values(2 * n);
    for (std::size_t k = 0; k < 2 * n; ++k)
        values[k] = smooth(from.x[k % n], k < n ? 1 : from.y[k % n]);
    Remapped const both = remap(from, to, values, 2, 2),
                   many = remap(from, to, values, 2, 2, &executor);
    CHECK(both.values == many.values);
    CHECK(both.covered == many.covered);
    CHECK(both.report.area == many.report.area);
    Remapped const second = remap(
        from, to, std::vector<double>(values.begin() + static_cast<long>(n), values.end()), 2);
    CHECK(std::equal(second.values.begin(), second.values.end(),
                     both.values.begin() + static_cast<long>(m)));
}

TEST_CASE("refused transfers") {
    Mesh const mesh = square_of(4, 1);
    Analysed const analysed(mesh);
    hm_error error;
    std::size_t bytes = 0;
    auto const size = [&](std::int32_t fields, std::int32_t order) {
        return hm_remap_size(analysed.analysis, analysed.analysis, fields, order, &bytes, &error);
    };
    CHECK(size(0, 1) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n_fields must be at least 1, not 0");
    CHECK(size(1, 3) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "order must be 1 or 2, not 3");
    REQUIRE(size(1, 1) == HM_OK);
    Guarded work(bytes, 0);
    std::vector<double> crooked = mesh.x, field(mesh.x.size(), 1.0), to(field), covered(field);
    crooked[6] += 1;
    hm_points const at = {crooked.data(), mesh.y.data(), 1};
    for (bool const source : {false, true}) {
        CHECK(hm_remap(analysed.analysis, source ? &at : nullptr, analysed.analysis,
                       source ? nullptr : &at, 1, 1, field.data(), to.data(), covered.data(),
                       work.data(), bytes, nullptr, nullptr, &error) == HM_BAD_MESH);
        CHECK(std::string(error.text).find("is inverted, so its control volumes are not defined") !=
              std::string::npos);
    }
    CHECK(to == field);
}
