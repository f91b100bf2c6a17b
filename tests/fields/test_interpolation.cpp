// Interpolation from mesh to mesh: linear fields are exact, smooth fields converge with second
// order, points outside are reported, and the transpose is the transpose.
#include <harmorph_fields.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/hybrid.hpp>
#include <fixtures/polygons.hpp>
#include <fixtures/memory.hpp>

#include <cmath>
#include <algorithm>
#include <random>
#include <string>

using namespace fixtures;

namespace {

struct Interpolated {
    Case setup;
    Mesh const& mesh = setup.mesh;
    Analysed analysed;
    std::unique_ptr<Guarded> block;
    hm_interpolation* object = nullptr;
    hm_interpolation_report report;
    std::vector<double> distance;

    Interpolated(Mesh const& from, std::vector<double> const& x, std::vector<double> const& y,
                 const hm_executor* executor = nullptr)
        : Interpolated(alone(from), x, y, executor) {}
    // The analysis has the conditions of the case.
    Interpolated(Case from, std::vector<double> const& x, std::vector<double> const& y,
                 const hm_executor* executor = nullptr)
        : setup(std::move(from)), analysed(setup), distance(x.size(), -1.0) {
        std::size_t bytes = 0;
        std::int32_t const n = static_cast<std::int32_t>(x.size());
        REQUIRE(fixtures::interpolation_size(analysed.analysis, n, &bytes, nullptr) == HM_OK);
        block = std::make_unique<Guarded>(bytes, 0);
        hm_points const to = {x.data(), y.data(), 1};
        HM_INIT(report);
        hm_error error;
        CHECK(hm_interpolation_init(&object, fixtures::Memory(block->data(), bytes - 1),
                                    analysed.analysis, nullptr, n, &to, nullptr, executor, nullptr,
                                    nullptr) == HM_BLOCK_TOO_SMALL);
        hm_status const status = hm_interpolation_init(
            &object, fixtures::Memory(block->data(), bytes), analysed.analysis, nullptr, n, &to,
            distance.data(), executor, &report, &error);
        INFO(error.text);
        REQUIRE(status == HM_OK);
    }
    static Case alone(Mesh const& mesh) {
        Case setup;
        setup.mesh = mesh;
        return setup;
    }
    template <class Field>
    std::vector<double> of(Field field) const {
        std::vector<double> from, to(distance.size());
        for (std::size_t k = 0; k < mesh.x.size(); ++k) from.push_back(field(mesh.x[k], mesh.y[k]));
        REQUIRE(hm_interpolate(object, 1, from.data(), to.data(), nullptr, nullptr) == HM_OK);
        return to;
    }
};

double linear(double x, double y) { return 0.3 + 2 * x - 0.7 * y; }
double smooth(double x, double y) { return std::sin(2 * x + 0.3) * std::cos(1.5 * y); }

// The largest error at the points inside.
template <class Field>
double error_of(Interpolated const& from, std::vector<double> const& x,
                std::vector<double> const& y, Field field) {
    std::vector<double> const found = from.of(field);
    double worst = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (from.distance[k] == 0)
            worst = std::fmax(worst, std::fabs(found[k] - field(x[k], y[k])));
    }
    return worst;
}

// Three rings of cells around a thin body with a sharp tip at (1, 0), all turned about the origin.
Mesh rings_around_a_tip(double turn) {
    Mesh mesh;
    std::vector<Point> const outline{{1, 0}, {0, 0.2}, {-1, 0.2}, {-1, -0.2}, {0, -0.2}};
    int const n = static_cast<int>(outline.size()), rings = 3;
    double const c = std::cos(turn), s = std::sin(turn);
    for (int ring = 0; ring <= rings; ++ring)
        for (Point const& p : outline)
            mesh.add_point({(ring + 1) * (c * p.x - s * p.y), (ring + 1) * (s * p.x + c * p.y)});
    for (int k = 0; k < n; ++k) {
        int const next = (k + 1) % n;
        for (int ring = 0; ring < rings; ++ring)
            mesh.add_quad(k + n * ring, k + n * (ring + 1), next + n * (ring + 1), next + n * ring,
                          k % 2 == 0);
        mesh.add_face(k, next, body);
        mesh.add_face(k + n * rings, next + n * rings, far_field);
    }
    return mesh;
}

}  // namespace

TEST_CASE("linear fields are exact between meshes of all kinds, in thin layers too") {
    std::vector<Mesh> meshes{
        naca0012_viscous(4000, 1e-7), naca0012_triangles(3000), square_of(20, 1),
        two_bodies(60, 20, {}, Ellipse{0.25, 0.06, 0.4}, Cells::hybrid), honeycomb(12, 40, 1, 3)};
    meshes[4].cell_layout = HM_CELLS_POLYGONS;
    for (std::size_t from = 0; from < meshes.size(); ++from) {
        for (std::size_t to = 0; to < meshes.size(); ++to) {
            CAPTURE(from);
            CAPTURE(to);
            Mesh const& points = meshes[to];
            Interpolated const found(meshes[from], points.x, points.y);
            double const extent = 25;  // of the largest mesh
            CHECK(error_of(found, points.x, points.y, linear) < 1e-13 * extent);
            int outside = 0;
            for (double const d : found.distance) outside += d > 0;
            CHECK(outside == found.report.outside);
            if (from == to) {
                CHECK(outside == 0);
                CHECK(error_of(found, points.x, points.y, smooth) < 1e-12);
            }
        }
    }
}

TEST_CASE("points in the cells, the bodies and outside: found as by trying all cells") {
    Mesh const mesh = two_bodies(40, 15, {}, Ellipse{0.25, 0.06, 0.4}, Cells::hybrid);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1.5, 2.5);
    std::vector<double> x, y;
    for (int k = 0; k < 3000; ++k) {
        double const scale = k % 3 == 0 ? 20 : 1;
        x.push_back(scale * uniform(random));
        y.push_back(scale * (uniform(random) - 0.5));
    }
    Interpolated const found(mesh, x, y);
    int wrong = 0, inside = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        bool is_inside = false;
        for (std::size_t i = 0; i + 1 < mesh.cell_start.size() && !is_inside; ++i) {
            std::int32_t const begin = mesh.cell_start[i], end = mesh.cell_start[i + 1];
            is_inside = true;
            for (std::int32_t c = begin; c < end; ++c) {
                std::int32_t const
                    a = mesh.cells[static_cast<std::size_t>(c)],
                    b = mesh.cells[static_cast<std::size_t>(c + 1 == end ? begin : c + 1)];
                if (twice_area(mesh.point(a), mesh.point(b), {x[k], y[k]}) < 0) is_inside = false;
            }
        }
        inside += is_inside;
        if (is_inside != (found.distance[k] == 0)) ++wrong;
    }
    CHECK(wrong == 0);
    CHECK(inside > 200);
    CHECK(inside < 2900);
    CHECK(found.report.outside == 3000 - inside);
    std::size_t const worst = static_cast<std::size_t>(found.report.max_distance_point);
    CHECK(found.distance[worst] == found.report.max_distance);
    CHECK(*std::max_element(found.distance.begin(), found.distance.end()) ==
          found.report.max_distance);
    // A point outside has a value of the boundary.
    std::vector<double> const values = found.of([](double px, double py) { return px + py; });
    for (std::size_t k = 0; k < values.size(); ++k)
        CHECK(std::fabs(values[k] - x[k] - y[k]) < 1.5 * found.distance[k] + 1e-12);
}

TEST_CASE("smooth fields converge with second order") {
    std::vector<double> error;
    for (int const n : {16, 32, 64}) {
        Mesh const to = square_of(n + 3, 2);
        error.push_back(error_of(Interpolated(square_of(n, 1), to.x, to.y), to.x, to.y, smooth));
    }
    CHECK(std::log2(error[0] / error[1]) > 1.8);
    CHECK(std::log2(error[1] / error[2]) > 1.8);
}

TEST_CASE("the transpose; several fields; threads and the order of points do not change bits") {
    Mesh const from = naca0012_triangles(3000), to = naca0012_viscous(6000, 1e-5);
    Backwards threads;
    hm_executor const executor = threads.executor(4);
    Interpolated const one(from, to.x, to.y), many(from, to.x, to.y, &executor);
    std::size_t const n = to.x.size(), m = from.x.size();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> f(2 * m), g(2 * n), value(2 * n), again(2 * n), back(2 * m, 0.0);
    for (double& each : f) each = uniform(random);
    for (double& each : g) each = uniform(random);
    REQUIRE(hm_interpolate(one.object, 2, f.data(), value.data(), nullptr, nullptr) == HM_OK);
    REQUIRE(hm_interpolate(many.object, 2, f.data(), again.data(), &executor, nullptr) == HM_OK);
    CHECK(value == again);
    CHECK(one.distance == many.distance);
    CHECK(one.report.max_distance_point == many.report.max_distance_point);
    REQUIRE(hm_interpolate_adjoint(one.object, 2, g.data(), back.data(), nullptr) == HM_OK);
    double forward = 0, backward = 0;
    for (std::size_t k = 0; k < 2 * n; ++k) forward += g[k] * value[k];
    for (std::size_t k = 0; k < 2 * m; ++k) backward += back[k] * f[k];
    CHECK(std::fabs(forward - backward) < 1e-12 * std::sqrt(static_cast<double>(n)));
}

TEST_CASE("refused interpolations") {
    Mesh const mesh = square_of(4, 1);
    Analysed const analysed(mesh);
    hm_error error;
    std::size_t bytes = 0;
    CHECK(fixtures::interpolation_size(analysed.analysis, -1, &bytes, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n is -1, but must be between 0 and 2^29");
    REQUIRE(fixtures::interpolation_size(analysed.analysis, 1, &bytes, nullptr) == HM_OK);
    Guarded block(bytes, 0);
    double x = 0.5, y = NAN;
    hm_points const to = {&x, &y, 1};
    hm_interpolation* object = nullptr;
    auto const init = [&](const hm_points* at) {
        return hm_interpolation_init(&object, fixtures::Memory(block.data(), bytes),
                                     analysed.analysis, at, 1, &to, nullptr, nullptr, nullptr,
                                     &error);
    };
    CHECK(init(nullptr) == HM_BAD_MESH);
    y = 0.5;
    std::vector<double> crooked = mesh.x;
    crooked[6] += 1;
    hm_points const at = {crooked.data(), mesh.y.data(), 1};
    CHECK(init(&at) == HM_BAD_MESH);
    CHECK(std::string(error.text).find("is inverted, so no point can be found in the mesh") !=
          std::string::npos);
    REQUIRE(init(nullptr) == HM_OK);
    std::vector<double> field(mesh.x.size(), 1.0);
    double value = 0;
    CHECK(hm_interpolate(object, 0, field.data(), &value, nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n_fields must be at least 1, not 0");
    CHECK(hm_interpolate_adjoint(object, 1, nullptr, field.data(), &error) == HM_BAD_ARGUMENT);
    REQUIRE(hm_interpolate(object, 1, field.data(), &value, nullptr, nullptr) == HM_OK);
    CHECK(std::fabs(value - 1) < 1e-15);
}

TEST_CASE("the conditions of an analysis change nothing: sides of a periodic pair are boundaries") {
    Case setup;
    setup.mesh = square_of(9, 0.4);
    enum { left = 40, right, walls, moved };
    for (std::size_t face = 0; face < setup.mesh.face_markers.size(); ++face) {
        double const x = setup.mesh.x[std::size_t(setup.mesh.faces[2 * face])],
                     to = setup.mesh.x[std::size_t(setup.mesh.faces[2 * face + 1])];
        setup.mesh.face_markers[face] = x == to ? (x < 0.5 ? left : right)
                                        : std::fmin(x, to) > 0.2 && std::fmax(x, to) < 0.8 ? moved
                                                                                           : walls;
    }
    std::mt19937 random(8);
    std::vector<double> x, y;
    for (int k = 0; k < 500; ++k) {
        x.push_back(std::uniform_real_distribution<double>(-0.1, 1.1)(random));
        y.push_back(std::uniform_real_distribution<double>(-0.1, 1.1)(random));
    }
    Interpolated const without(setup.mesh, x, y);
    setup.set_periodic(right, left);
    setup.set_given(moved);
    Interpolated const with(setup, x, y);
    CHECK(with.of(smooth) == without.of(smooth));
    CHECK(with.distance == without.distance);
}

TEST_CASE("behind a sharp corner of a body, points are found from both faces of the corner") {
    for (double const turn : {0.0, 0.3, 1.4, 2.0, 3.1, -0.7, -2.2}) {
        Mesh const mesh = rings_around_a_tip(turn);
        double const c = std::cos(turn), s = std::sin(turn);
        int outside = 0;
        for (double const radius : {1e-3, 0.05, 0.2})
            for (int k = -14; k <= 14; ++k) {
                double const px = 1 + radius * std::cos(0.1 * k), py = radius * std::sin(0.1 * k);
                // Each point is alone, so that the search begins at the boundary.
                Interpolated const found(mesh, {c * px - s * py}, {s * px + c * py});
                outside += found.report.outside;
            }
        CHECK(outside == 0);
    }
}
