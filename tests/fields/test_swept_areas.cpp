// Swept areas: opposite in the two cells of a side, with the sign of the header, the same bits for
// any number of threads, refusals. The kind `fields` of tests/fuzz compares the areas of all sides,
// halves and faces of the dual with products in twice the precision, in every layout of cells.
#include <harmorph_fields.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/executors.hpp>

#include <complex>
#include <map>
#include <numeric>
#include <random>
#include <string>

namespace {

struct Positions {
    std::vector<double> x, y;
    hm_points view() const { return {x.data(), y.data(), 1}; }
};

struct Swept {
    std::vector<double> sides, duals, halves;
    explicit Swept(std::int64_t n)
        : sides(static_cast<std::size_t>(n), -7.0), duals(sides), halves(2 * sides.size(), -7.0) {}
};

fixtures::Mesh hybrid(int round, int layers) {
    return fixtures::two_bodies(round, layers, {}, fixtures::Ellipse{0.25, 0.06, 0.4},
                                fixtures::Cells::hybrid);
}

Positions moved_at_random(fixtures::Mesh const& mesh, unsigned seed) {
    Positions to{mesh.x, mesh.y};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.01, 0.01);
    for (double& x : to.x) x += uniform(random);
    for (double& y : to.y) y += uniform(random);
    return to;
}

}  // namespace

TEST_CASE("a side has exactly opposite areas in its two cells; threads do not change bits") {
    fixtures::Mesh const mesh = hybrid(40, 30);
    Positions const to = moved_at_random(mesh, 1);
    hm_mesh const view = mesh.view();
    hm_points const target = to.view();
    std::int64_t n = 0;
    REQUIRE(hm_swept_count(&view, &n, nullptr) == HM_OK);
    Swept one(n), many(n);
    fixtures::Backwards threads;
    hm_executor const executor = threads.executor(4);
    REQUIRE(hm_swept_areas(&view, nullptr, &target, one.sides.data(), one.duals.data(), nullptr,
                           nullptr, nullptr) == HM_OK);
    REQUIRE(hm_swept_areas(&view, nullptr, &target, many.sides.data(), many.duals.data(), nullptr,
                           &executor, nullptr) == HM_OK);
    CHECK(one.sides == many.sides);
    CHECK(one.duals == many.duals);
    CHECK(one.halves[0] == -7);
    std::map<fixtures::Edge, double> seen;
    int pairs = 0, different = 0;
    for (std::size_t i = 0; i + 1 < mesh.cell_start.size(); ++i) {
        std::int32_t const begin = mesh.cell_start[i], end = mesh.cell_start[i + 1];
        for (std::int32_t k = begin; k < end; ++k) {
            std::int32_t const
                a = mesh.cells[static_cast<std::size_t>(k)],
                b = mesh.cells[static_cast<std::size_t>(k + 1 == end ? begin : k + 1)];
            auto const other = seen.find({b, a});
            seen[{a, b}] = one.sides[static_cast<std::size_t>(k)];
            if (other == seen.end()) continue;
            ++pairs;
            if (other->second != -one.sides[static_cast<std::size_t>(k)]) ++different;
        }
    }
    CHECK(pairs > 1000);
    CHECK(different == 0);
}

TEST_CASE("all kernels give the same bits, also where a batch is not full, and in small meshes") {
    for (int const round : {7, 11, 80}) {
        fixtures::Mesh const mesh = hybrid(round, 6);
        Positions const to = moved_at_random(mesh, 2);
        hm_mesh const view = mesh.view();
        hm_points const target = to.view();
        std::int64_t n = 0;
        REQUIRE(hm_swept_count(&view, &n, nullptr) == HM_OK);
        Swept plain(n);
        REQUIRE(hm_swept_areas(&view, nullptr, &target, plain.sides.data(), plain.duals.data(),
                               plain.halves.data(), nullptr, nullptr) == HM_OK);
        for (harmorph::Kernel const kernel : fixtures::usable_kernels()) {
            fixtures::Backwards threads;
            hm_executor executor = threads.executor(2);
            executor.kernel = static_cast<std::int32_t>(kernel);
            Swept found(n);
            REQUIRE(hm_swept_areas(&view, nullptr, &target, found.sides.data(), found.duals.data(),
                                   found.halves.data(), &executor, nullptr) == HM_OK);
            CHECK(found.sides == plain.sides);
            CHECK(found.duals == plain.duals);
            CHECK(found.halves == plain.halves);
        }
    }
}

TEST_CASE("the sign: a side that moves outwards from a counter-clockwise cell is positive") {
    double const x[] = {0, 1, 0}, y[] = {0, 0, 1}, to_x[] = {0, 2, 0};
    std::int32_t const cell[] = {0, 1, 2};
    auto mesh = fixtures::sized<hm_mesh>();
    mesh.n_points = 3;
    mesh.points = {x, y, 1};
    mesh.cell_layout = HM_CELLS_TRIANGLES;
    mesh.n_cells = 1;
    mesh.cell_points = cell;
    hm_points const to = {to_x, y, 1};
    double sides[3] = {}, duals[3] = {}, halves[6] = {};
    REQUIRE(hm_swept_areas(&mesh, nullptr, &to, sides, duals, halves, nullptr, nullptr) == HM_OK);
    CHECK(sides[0] == 0);    // slides along itself
    CHECK(sides[1] == 0.5);  // turns about point 2
    CHECK(sides[2] == 0);    // does not move
    CHECK(halves[2] == 0.375);
    CHECK(halves[3] == 0.125);
    CHECK(duals[0] > 0);  // moves away from point 0, whose control volume grows
}

TEST_CASE("areas of a polygon and of its control volumes change by what their sides sweep") {
    using Real = long double;
    using Place = std::complex<Real>;
    auto const area_of = [](std::vector<Place> const& corners) {
        Real twice = 0;
        for (std::size_t k = 0; k < corners.size(); ++k)
            twice += std::imag(std::conj(corners[k] - corners[0]) *
                               (corners[(k + 1) % corners.size()] - corners[0]));
        return twice / 2;
    };
    for (std::size_t n = 3; n <= 9; ++n) {
        std::mt19937 random(static_cast<unsigned>(n));
        std::uniform_real_distribution<double> uniform(-0.05, 0.05);
        Positions from, to;
        std::vector<std::int32_t> cell;
        for (std::size_t k = 0; k < n; ++k) {
            double const angle = 2 * fixtures::pi * static_cast<double>(k) / static_cast<double>(n);
            cell.push_back(static_cast<std::int32_t>(k));
            from.x.push_back(std::cos(angle) + uniform(random));
            from.y.push_back(std::sin(angle) + uniform(random));
            to.x.push_back(from.x[k] + 0.3 + uniform(random));
            to.y.push_back(from.y[k] - 0.2 + uniform(random));
        }
        std::int32_t const start[] = {0, static_cast<std::int32_t>(n)};
        auto mesh = fixtures::sized<hm_mesh>();
        mesh.n_points = start[1];
        mesh.points = from.view();
        mesh.cell_layout = HM_CELLS_POLYGONS;
        mesh.n_cells = 1;
        mesh.cell_start = start;
        mesh.cell_points = cell.data();
        hm_points const target = to.view();
        Swept swept(start[1]);
        REQUIRE(hm_swept_areas(&mesh, nullptr, &target, swept.sides.data(), swept.duals.data(),
                               swept.halves.data(), nullptr, nullptr) == HM_OK);
        // The area of the cell, or of the part of it that belongs to corner k.
        auto const part = [&](Positions const& at, std::size_t k) {
            std::vector<Place> corners;
            for (std::size_t i = 0; i < n; ++i) corners.emplace_back(at.x[i], at.y[i]);
            if (k == n) return area_of(corners);
            Place const centre =
                std::accumulate(corners.begin(), corners.end(), Place()) / static_cast<Real>(n);
            Place const here = corners[k], next = corners[(k + 1) % n],
                        before = corners[(k + n - 1) % n];
            return area_of({here, (here + next) / Real(2), centre, (here + before) / Real(2)});
        };
        Real all = 0;
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t const before = (k + n - 1) % n;
            Real const change = Real(swept.duals[k]) - swept.duals[before] + swept.halves[2 * k] +
                                swept.halves[2 * before + 1];
            CHECK(std::fabs(change - (part(to, k) - part(from, k))) < 1e-15L);
            all += swept.sides[k];
        }
        CHECK(std::fabs(all - (part(to, n) - part(from, n))) < 1e-15L);
    }
}

TEST_CASE("a triangle that repeats its last point has no area at the side between both") {
    double const x[] = {0, 1, 0.2, 1.3}, y[] = {0, 0.1, 1, 1.2};
    double const to_x[] = {0.1, 1.3, 0.3, 1.7}, to_y[] = {0.2, 0.1, 1.4, 1.5};
    std::int32_t const triangles[] = {0, 1, 2, 2, 1, 3}, quads[] = {0, 1, 2, 2, 2, 1, 3, 3};
    auto mesh = fixtures::sized<hm_mesh>();
    mesh.n_points = 4;
    mesh.points = {x, y, 1};
    mesh.n_cells = 2;
    hm_points const to = {to_x, to_y, 1};
    Swept three(6), four(8);
    auto const sweep = [&](std::int32_t layout, const std::int32_t* cells, Swept& swept) {
        mesh.cell_layout = layout;
        mesh.cell_points = cells;
        REQUIRE(hm_swept_areas(&mesh, nullptr, &to, swept.sides.data(), swept.duals.data(),
                               swept.halves.data(), nullptr, nullptr) == HM_OK);
    };
    sweep(HM_CELLS_TRIANGLES, triangles, three);
    sweep(HM_CELLS_QUADS, quads, four);
    for (std::size_t k = 0; k < 8; ++k) {
        bool const is_repeated = k % 4 == 2;
        std::size_t const side = k / 4 * 3 + (k % 4 == 3 ? 2 : k % 4);
        CHECK(four.sides[k] == (is_repeated ? 0 : three.sides[side]));
        CHECK(four.duals[k] == (is_repeated ? 0 : three.duals[side]));
        for (std::size_t end = 0; end < 2; ++end)
            CHECK(four.halves[2 * k + end] == (is_repeated ? 0 : three.halves[2 * side + end]));
    }
}

TEST_CASE("refused swept areas leave the arrays as they were") {
    fixtures::Mesh const mesh =
        fixtures::two_bodies(8, 5, {}, fixtures::Ellipse{0.25, 0.06, 0.4}, fixtures::Cells::quads);
    hm_mesh view = mesh.view();
    hm_points to = view.points;
    std::int64_t n = 0;
    REQUIRE(hm_swept_count(&view, &n, nullptr) == HM_OK);
    Swept swept(n);
    hm_error error;
    auto const call = [&] {
        return hm_swept_areas(&view, nullptr, &to, swept.sides.data(), nullptr, nullptr, nullptr,
                              &error);
    };
    std::vector<double> bad = mesh.x;
    bad[7] = NAN;
    to.x = bad.data();
    CHECK(call() == HM_BAD_MESH);
    CHECK(error.item == 7);
    to.x = nullptr;
    CHECK(call() == HM_BAD_ARGUMENT);
    to = view.points;
    CHECK(hm_swept_areas(&view, nullptr, &to, nullptr, nullptr, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "sides, duals and halves are all NULL; ask for at least one array");
    CHECK(hm_swept_areas(&view, nullptr, nullptr, swept.sides.data(), nullptr, nullptr, nullptr,
                         &error) == HM_BAD_ARGUMENT);
    CHECK(hm_swept_count(&view, nullptr, &error) == HM_BAD_ARGUMENT);
    std::vector<std::int32_t> cells = mesh.cells;
    cells[3] = view.n_points;
    view.cell_points = cells.data();
    CHECK(call() == HM_BAD_MESH);
    for (double const area : swept.sides) CHECK(area == -7);
}
