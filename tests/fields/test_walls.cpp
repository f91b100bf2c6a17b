// Distances to the walls: against trying all faces, with and without hints, after movements;
// heights of the first layer. The kind `fields` of tests/fuzz compares the derivatives of distances
// with formulas in more digits and with the transpose.
#include <harmorph_fields.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/core.hpp>
#include <fixtures/executors.hpp>
#include <fixtures/hybrid.hpp>
#include <fixtures/memory.hpp>

#include <cmath>
#include <random>
#include <string>

using namespace fixtures;

namespace {

// The walls of a mesh with the markers body and second_body, in a guarded block.
struct WallSet {
    Mesh mesh;
    Analysed analysed;
    std::unique_ptr<Guarded> block;
    hm_walls* walls = nullptr;
    hm_walls_info info;

    explicit WallSet(Mesh const& given, std::vector<std::int32_t> const& markers)
        : mesh(given), analysed(mesh) {
        std::size_t bytes = 0;
        std::int32_t const n = static_cast<std::int32_t>(markers.size());
        REQUIRE(fixtures::walls_size(analysed.analysis, n, markers.data(), &bytes, nullptr) ==
                HM_OK);
        block = std::make_unique<Guarded>(bytes, 0);
        CHECK(hm_walls_init(&walls, fixtures::Memory(block->data(), bytes - 1), analysed.analysis,
                            n, markers.data(), nullptr, nullptr) == HM_BLOCK_TOO_SMALL);
        REQUIRE(hm_walls_init(&walls, fixtures::Memory(block->data(), bytes), analysed.analysis, n,
                              markers.data(), nullptr, nullptr) == HM_OK);
        HM_INIT(info);
        REQUIRE(hm_walls_info_get(walls, &info, nullptr) == HM_OK);
    }
    hm_points at() const { return {mesh.x.data(), mesh.y.data(), 1}; }
    void move() {
        hm_points const now = at();
        REQUIRE(hm_walls_move(walls, &now, nullptr) == HM_OK);
    }
};

struct Distances {
    std::vector<double> distance, parameter;
    std::vector<std::int32_t> face;
    Distances(WallSet const& set, std::vector<double> const& x, std::vector<double> const& y,
              const std::int32_t* hint = nullptr, const hm_executor* executor = nullptr)
        : distance(x.size()), parameter(x.size()), face(x.size()) {
        hm_points const points = {x.data(), y.data(), 1};
        REQUIRE(hm_wall_distance(set.walls, static_cast<std::int32_t>(x.size()), &points, hint,
                                 distance.data(), face.data(), parameter.data(), executor,
                                 nullptr) == HM_OK);
    }
    bool operator==(Distances const& other) const {
        return distance == other.distance && parameter == other.parameter && face == other.face;
    }
};

long double exact_distance(WallSet const& set, std::int32_t face, double px, double py,
                           long double* t_found = nullptr) {
    auto const x = [&](int end) {
        return static_cast<long double>(
            set.mesh.x[static_cast<std::size_t>(set.info.face_points[2 * face + end])]);
    };
    auto const y = [&](int end) {
        return static_cast<long double>(
            set.mesh.y[static_cast<std::size_t>(set.info.face_points[2 * face + end])]);
    };
    long double const ax = x(1) - x(0), ay = y(1) - y(0), square = ax * ax + ay * ay;
    long double t = square > 0 ? ((px - x(0)) * ax + (py - y(0)) * ay) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    if (t_found != nullptr) *t_found = t;
    return std::hypot(px - x(0) - t * ax, py - y(0) - t * ay);
}

// Moves the points by a smooth field that keeps the mesh valid.
void bend(Mesh& mesh, double amount) {
    for (std::size_t k = 0; k < mesh.x.size(); ++k) {
        double const x = mesh.x[k], y = mesh.y[k];
        mesh.x[k] = x + amount * std::sin(2 * y + 1);
        mesh.y[k] = y + amount * std::cos(3 * x);
    }
}

}  // namespace

TEST_CASE("points of walls and of layers count from the index base") {
    Case setup = two_body_case(Cells::hybrid, 8, 5);
    std::vector<std::int32_t> const markers = {body, second_body};
    std::vector<std::int32_t> found[2];
    for (std::int32_t const base : {0, 1}) {
        setup.index_base = base;
        Analysed const seen(setup);
        std::size_t bytes = 0;
        REQUIRE(fixtures::walls_size(seen.analysis, 2, markers.data(), &bytes, nullptr) == HM_OK);
        Guarded block(bytes, 0);
        hm_walls* walls = nullptr;
        REQUIRE(hm_walls_init(&walls, fixtures::Memory(block.data(), bytes), seen.analysis, 2,
                              markers.data(), nullptr, nullptr) == HM_OK);
        hm_walls_info info;
        HM_INIT(info);
        REQUIRE(hm_walls_info_get(walls, &info, nullptr) == HM_OK);
        auto const take = [&](const std::int32_t* from, std::int32_t n) {
            for (std::int32_t k = 0; k < n; ++k) found[base].push_back(from[k] - base);
        };
        take(info.face_points, 2 * info.n_faces);
        take(info.wall_points, info.n_wall_points);
        take(info.layer_points, info.n_wall_points);
    }
    CHECK(found[0].size() > 20);
    CHECK(found[0] == found[1]);
}

TEST_CASE("distances of mesh points and other points, before and after movements") {
    for (bool const two : {false, true}) {
        WallSet set(
            two ? two_bodies(60, 30, {}, Ellipse{0.25, 0.06, 0.4}, Cells::hybrid)
                : naca0012_viscous(20000, 1e-6),
            two ? std::vector<std::int32_t>{body, second_body} : std::vector<std::int32_t>{body});
        std::mt19937 random(2);
        std::uniform_real_distribution<double> uniform(-3, 3);
        std::vector<std::int32_t> hint;
        for (int step = 0; step < 3; ++step) {
            std::vector<double> x = set.mesh.x, y = set.mesh.y;
            for (int k = 0; k < 300; ++k) {
                x.push_back(uniform(random));
                y.push_back(uniform(random));
            }
            Distances const found(set, x, y);
            if (step > 0) CHECK(found == Distances(set, x, y, hint.data()));
            Backwards threads;
            hm_executor const executor = threads.executor(3);
            CHECK(found == Distances(set, x, y, nullptr, &executor));
            for (std::size_t k = 0; k < x.size(); ++k)
                hint.push_back(static_cast<std::int32_t>(random()));
            CHECK(found == Distances(set, x, y, hint.data()));
            hint = found.face;
            int wrong = 0;
            for (std::size_t k = 0; k < x.size(); k += 7) {
                long double least = INFINITY, t = 0;
                for (std::int32_t face = 0; face < set.info.n_faces; ++face)
                    least = std::fmin(least, exact_distance(set, face, x[k], y[k]));
                // The face found is a nearest one, and distance and parameter are those of the
                // face.
                double const tolerance = 1e-15 * (1 + static_cast<double>(least));
                long double const own = exact_distance(set, found.face[k], x[k], y[k], &t);
                if (std::fabs(static_cast<double>(own - least)) > tolerance) ++wrong;
                if (std::fabs(found.distance[k] - static_cast<double>(least)) >
                    8e-16 * static_cast<double>(least) + 1e-17)
                    ++wrong;
                if (std::fabs(found.parameter[k] - static_cast<double>(t)) > 1e-11) ++wrong;
            }
            CHECK(wrong == 0);
            for (std::int32_t k = 0; k < set.info.n_wall_points; ++k)
                CHECK(found.distance[static_cast<std::size_t>(set.info.wall_points[k])] == 0);
            bend(set.mesh, 0.05);
            set.move();
        }
    }
}

TEST_CASE(
    "a translated mesh keeps its distances, a scaled one scales them; both by the derivative") {
    WallSet set(two_bodies(40, 20, {}, Ellipse{0.25, 0.06, 0.4}, Cells::quads), {body});
    std::size_t const n = set.mesh.x.size();
    std::int32_t const count = static_cast<std::int32_t>(n);
    Distances const found(set, set.mesh.x, set.mesh.y);
    hm_points const at = set.at();
    std::vector<double> const one(n, 1.0), two(n, 2.0);
    std::vector<double> change(n);
    hm_points const shift = {one.data(), two.data(), 1};
    REQUIRE(hm_wall_distance_change(set.walls, count, &at, found.face.data(), &shift, &shift,
                                    change.data(), nullptr) == HM_OK);
    for (double const c : change) CHECK(std::fabs(c) < 1e-15);
    REQUIRE(hm_wall_distance_change(set.walls, count, &at, found.face.data(), &at, &at,
                                    change.data(), nullptr) == HM_OK);
    for (std::size_t k = 0; k < n; ++k) CHECK(std::fabs(change[k] - found.distance[k]) < 1e-13);
}

TEST_CASE("heights of the first layer: in a ring they are known") {
    // Straight rays between circles of radius 1 and 1.01.
    Mesh ring;
    int const n = 90;
    double const pi = std::acos(-1.0);
    for (double const r : {1.0, 1.01, 3.0}) {
        for (int k = 0; k < n; ++k)
            ring.add_point({r * std::cos(2 * pi * k / n), r * std::sin(2 * pi * k / n)});
    }
    for (int layer = 0; layer < 2; ++layer) {
        for (int k = 0; k < n; ++k) {
            std::int32_t const a = layer * n + k, b = layer * n + (k + 1) % n;
            ring.add_cell({a, a + n, b + n, b});
        }
    }
    for (int k = 0; k < n; ++k) {
        ring.add_face((k + 1) % n, k, body);
        ring.add_face(2 * n + k, 2 * n + (k + 1) % n, far_field);
    }
    WallSet set(ring, {body});
    REQUIRE(set.info.n_wall_points == n);
    std::vector<double> heights(static_cast<std::size_t>(n));
    hm_points const at = set.at();
    REQUIRE(hm_first_layer(set.walls, nullptr, &at, heights.data(), nullptr, nullptr, nullptr) ==
            HM_OK);
    for (int k = 0; k < n; ++k) {
        CHECK(set.info.layer_points[k] == set.info.wall_points[k] + n);
        CHECK(std::fabs(heights[static_cast<std::size_t>(k)] - 0.01) < 1e-15);
    }
}

TEST_CASE("refused calls with walls") {
    WallSet set(two_bodies(8, 5, {}, Ellipse{0.25, 0.06, 0.4}, Cells::quads), {body});
    std::size_t bytes = 0;
    hm_error error;
    std::int32_t const markers[] = {body, 77};
    CHECK(fixtures::walls_size(set.analysed.analysis, 2, markers, &bytes, &error) ==
          HM_BAD_CONDITION);
    CHECK(std::string(error.text) == "no face of the boundary has the marker 77");
    CHECK(fixtures::walls_size(set.analysed.analysis, 0, markers, &bytes, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n_markers must be at least 1, not 0");
    std::vector<double> x = set.mesh.x, distance(x.size(), -1.0);
    hm_points points = {x.data(), set.mesh.y.data(), 1};
    std::int32_t const n = static_cast<std::int32_t>(x.size());
    x[0] = INFINITY;
    CHECK(hm_walls_move(set.walls, &points, &error) == HM_BAD_MESH);
    CHECK(std::string(error.text) ==
          "point 0 has a coordinate that is not finite or larger than 1e100");
    CHECK(hm_wall_distance(set.walls, n, &points, nullptr, distance.data(), nullptr, nullptr,
                           nullptr, &error) == HM_BAD_MESH);
    CHECK(hm_wall_distance(set.walls, -1, &points, nullptr, distance.data(), nullptr, nullptr,
                           nullptr, &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "n is -1, but must not be negative");
    for (double const d : distance) CHECK(d == -1);
    x[0] = 0;
    std::vector<std::int32_t> face(x.size(), 0);
    face[3] = set.info.n_faces;
    CHECK(hm_wall_distance_change(set.walls, n, &points, face.data(), nullptr, nullptr,
                                  distance.data(), &error) == HM_BAD_ARGUMENT);
    CHECK(error.item == 3);
    CHECK(std::string(error.text).find("is no face of the walls") != std::string::npos);
    CHECK(hm_wall_distance_adjoint(set.walls, n, &points, face.data(), distance.data(), nullptr,
                                   nullptr, &error) == HM_BAD_ARGUMENT);
}

TEST_CASE("points may be farther away than 1e100 times the width of the walls") {
    Mesh mesh = two_bodies(40, 8, {}, Ellipse{0.25, 0.06, 0.4}, Cells::hybrid);
    for (double const scale : {1.0, 1e-30, 1e-90}) {
        for (double& x : mesh.x) x *= scale;
        for (double& y : mesh.y) y *= scale;
        WallSet const set(mesh, {body, second_body});
        for (double const away : {1e50, 1e80, 1e100}) {
            std::vector<double> x, y;
            for (int k = 0; k < 16; ++k) {
                x.push_back(away * std::cos(0.4 * k));
                y.push_back(away * std::sin(0.4 * k));
            }
            Distances const found(set, x, y);
            for (std::size_t k = 0; k < x.size(); ++k) {
                CHECK(found.face[k] >= 0);
                CHECK(found.face[k] < set.info.n_faces);
                CHECK(found.distance[k] == doctest::Approx(away).epsilon(1e-14));
            }
        }
        for (double& x : mesh.x) x /= scale;
        for (double& y : mesh.y) y /= scale;
    }
}
