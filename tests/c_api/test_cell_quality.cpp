// The quality of each cell (hm_quality_report.cell_quality): the formula of the header for each
// cell, and one number for the same cell in every way of asking. hm_first_layer for each wall
// point.
#include <harmorph_fields.h>
#include "fixtures/memory.hpp"
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace fixtures;

namespace {

using Numbers = std::vector<double>;

constexpr double behind = -7;  // stands behind the last cell, and in arrays of refused calls

struct Asked {
    hm_quality_report report = sized<hm_quality_report>();
    hm_step_report step = sized<hm_step_report>();
    Numbers cells;
    hm_status status = HM_OK;

    // The array ends with a number that must stay.
    Asked(const hm_basis* basis, hm_mesh const& mesh, std::size_t n_cells, const hm_points* from,
          const hm_points* by, const hm_points* reference, const hm_executor* executor = nullptr,
          bool wants_step = false)
        : cells(n_cells + 1, behind) {
        report.cell_quality = cells.data();
        status = hm_assess(basis, &mesh, from, by, reference, executor,
                           wants_step ? &step : nullptr, &report, nullptr);
        CHECK(report.cell_quality == cells.data());
        CHECK(cells.back() == behind);
        cells.pop_back();
        report.cell_quality = nullptr;
    }
    // What the report says of all cells is said of the array.
    void check_report(std::int32_t index_base) const {
        REQUIRE(status == HM_OK);
        auto const least = std::min_element(cells.begin(), cells.end());
        CHECK(report.min_quality == *least);
        CHECK(report.min_quality_cell == std::int32_t(least - cells.begin()) + index_base);
        double const mean =
            std::accumulate(cells.begin(), cells.end(), 0.0) / static_cast<double>(cells.size());
        CHECK(report.mean_quality == doctest::Approx(mean).epsilon(1e-13));
        CHECK(report.inverted == std::count(cells.begin(), cells.end(), 0.0));
        if (report.inverted > 0) CHECK(cells[std::size_t(report.first_inverted - index_base)] == 0);
        CHECK(*least >= 0);
        CHECK(*std::max_element(cells.begin(), cells.end()) <= 1 + 1e-15);
    }
};

// The formula of the header, for a cell without an inverted corner; `all` corners of a
// quadrilateral count, and of a polygon those that are convex.
double expected_quality(std::vector<Point> const& p, std::vector<Point> const& before, bool all) {
    double shape = 0;
    if (p.size() == 3) {
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k)
            squares += distance(p[k], p[(k + 1) % 3]) * distance(p[k], p[(k + 1) % 3]);
        shape = 4 * std::sqrt(3.0) * shoelace(p) / squares;
    } else if (all) {
        for (std::size_t k = 0; k < 4; ++k) {
            Point const a = p[(k + 3) % 4], b = p[k], c = p[(k + 1) % 4];
            shape += distance(a, b) * distance(b, c) / twice_area(a, b, c) / 4;
        }
        shape = 1 / shape;
    } else {
        shape = polygon_quality(p);
    }
    double const t = shoelace(p) / shoelace(before);
    return shape * std::sqrt(std::min(t, 1 / t));
}

Numbers sum_of(Numbers const& a, Numbers const& b) {
    Numbers out = a;
    for (std::size_t k = 0; k < a.size(); ++k) out[k] += b[k];
    return out;
}

}  // namespace

TEST_CASE("cell quality: each cell has its number, of which the report has extremes and mean") {
    for (std::int32_t const base : {0, 1})
        for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid})
            for (double const size : {1e-5, 2e-3, 1.0}) {  // the last one inverts cells
                Case setup = airfoil_case(40, 12, kind);
                setup.index_base = base;
                Solved const solved(setup);
                hm_mesh const mesh = setup.mesh_view();
                std::size_t const n = std::size_t(setup.mesh.n_cells());
                Moved const by =
                    displaced(solved.basis, some_move(setup.curves.n_control(), size, 5));
                Numbers const x = sum_of(setup.mesh.x, by.x), y = sum_of(setup.mesh.y, by.y);
                hm_points const along{by.x.data(), by.y.data(), 1}, to{x.data(), y.data(), 1};
                Asked const asked(solved.basis, mesh, n, nullptr, &along, nullptr, nullptr, true);
                asked.check_report(base);
                CHECK((asked.report.inverted > 0) == (size == 1.0));
                std::int32_t wrong = 0;
                for (std::int32_t cell = 0; cell < setup.mesh.n_cells(); ++cell) {
                    double const found = asked.cells[std::size_t(cell)];
                    std::vector<Point> const now = outline(setup.mesh, cell, x, y),
                                             before = outline(setup.mesh, cell, setup.mesh.x,
                                                              setup.mesh.y);
                    if (found > 0 && std::fabs(found - expected_quality(now, before, true)) > 1e-12)
                        ++wrong;
                }
                CHECK(wrong == 0);
                // The same numbers without the step, with any threads, and at moved points.
                Backwards order;
                hm_executor const executor = order.executor(4);
                Asked const alone(solved.basis, mesh, n, nullptr, &along, nullptr, &executor);
                alone.check_report(base);
                CHECK(same_bits(alone.cells, asked.cells));
                CHECK(order.tasks > 1);
                Asked const compared(solved.basis, mesh, n, nullptr, &along, &mesh.points),
                    moved(solved.basis, mesh, n, &to, nullptr, &mesh.points),
                    shapes(solved.basis, mesh, n, &to, nullptr, nullptr);
                for (Asked const* one : {&compared, &moved, &shapes}) one->check_report(base);
                for (std::size_t k = 0; k < n; ++k) {
                    CHECK(compared.cells[k] == doctest::Approx(asked.cells[k]).epsilon(1e-9));
                    CHECK(moved.cells[k] == doctest::Approx(asked.cells[k]).epsilon(1e-9));
                    CHECK(shapes.cells[k] >= moved.cells[k] * (1 - 1e-12));
                }
                // The array changes nothing else.
                auto plain = sized<hm_quality_report>();
                REQUIRE(hm_assess(solved.basis, &mesh, nullptr, &along, nullptr, nullptr, nullptr,
                                  &plain, nullptr) == HM_OK);
                CHECK(std::memcmp(&plain, &alone.report, sizeof plain) == 0);
            }
}

TEST_CASE("cell quality: one cell has one number, wherever it is in the list and in any layout") {
    for (Cells const kind : {Cells::quads, Cells::triangles, Cells::hybrid}) {
        Case setup = two_body_case(kind, 8, 6);
        std::size_t const n = std::size_t(setup.mesh.n_cells());
        Numbers const number_of_cell = [&] {  // of which cell a number is, by its points
            Solved const solved(setup);
            hm_mesh const mesh = setup.mesh_view();
            Asked const first(solved.basis, mesh, n, nullptr, nullptr, nullptr);
            first.check_report(0);
            hm_mesh quads = mesh;
            std::vector<std::int32_t> const four = quads_of(setup.mesh);
            quads.cell_layout = HM_CELLS_QUADS;
            quads.cell_start = nullptr;
            quads.cell_points = four.data();
            CHECK(same_bits(Asked(solved.basis, quads, n, nullptr, nullptr, nullptr).cells,
                            first.cells));
            return first.cells;
        }();
        Case other = setup;
        shuffle_cells(other.mesh, 3);
        Solved const solved(other);
        hm_mesh const mesh = other.mesh_view();
        Asked const shuffled(solved.basis, mesh, n, nullptr, nullptr, nullptr);
        std::int32_t wrong = 0;
        for (std::int32_t cell = 0; cell < other.mesh.n_cells(); ++cell) {
            for (std::int32_t was = 0; was < setup.mesh.n_cells(); ++was) {
                if (corners_of(other.mesh, cell) != corners_of(setup.mesh, was)) continue;
                if (shuffled.cells[std::size_t(cell)] != number_of_cell[std::size_t(was)]) ++wrong;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("cell quality: polygons, and cells that are too small for products of areas") {
    for (NamedCase& named : polygon_cases()) {
        CAPTURE(named.name);
        Mesh const mesh = counter_clockwise(named.setup.mesh);
        hm_mesh const view = in_polygons(named.setup.mesh_view());
        Solved const solved(named.setup.problem(view));
        Numbers x = mesh.x, y = mesh.y;
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] *= 1.5;
            y[k] = 0.9 * y[k] + 0.1 * x[k];
        }
        hm_points const at{x.data(), y.data(), 1};
        Asked const asked(solved.basis, view, std::size_t(mesh.n_cells()), &at, nullptr,
                          &view.points);
        asked.check_report(view.index_base);
        std::int32_t wrong = 0, compared = 0;
        for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
            std::vector<Point> const now = outline(mesh, cell, x, y),
                                     before = outline(mesh, cell, mesh.x, mesh.y);
            bool convex = true;  // corners keep the kind that they have at the start
            for (std::size_t k = 0; k < now.size(); ++k)
                convex &= is_convex_corner(before, k) == is_convex_corner(now, k);
            if (!convex || asked.cells[std::size_t(cell)] == 0) continue;
            ++compared;
            double const expected = expected_quality(now, before, false);
            if (std::fabs(asked.cells[std::size_t(cell)] - expected) > 1e-11) ++wrong;
        }
        CHECK(wrong == 0);
        CHECK(compared > mesh.n_cells() / 2);
    }
    for (Cells const kind : {Cells::quads, Cells::triangles}) {
        Case setup = airfoil_case(20, 8, kind);
        Solved const solved(setup);
        hm_mesh const mesh = setup.mesh_view();
        std::size_t const n = std::size_t(setup.mesh.n_cells());
        Asked const usual(solved.basis, mesh, n, nullptr, nullptr, nullptr);
        Numbers x = setup.mesh.x, y = setup.mesh.y;
        for (double& number : x) number *= 1e-90;
        for (double& number : y) number *= 1e-90;
        hm_points const at{x.data(), y.data(), 1};
        Asked const tiny(solved.basis, mesh, n, &at, nullptr, nullptr);
        tiny.check_report(0);
        for (std::size_t k = 0; k < n; ++k)
            CHECK(tiny.cells[k] == doctest::Approx(usual.cells[k]).epsilon(1e-10));
    }
}

TEST_CASE("cell quality: a refused call leaves the array, which must be apart from the points") {
    Case setup = tiny_case(), larger = airfoil_case(20, 8, Cells::quads);
    Solved const solved(setup), another(larger);
    hm_mesh const mesh = setup.mesh_view();
    std::size_t const n = std::size_t(setup.mesh.n_cells());
    Asked const foreign(another.basis, mesh, n, nullptr, nullptr, nullptr);
    CHECK(foreign.status == HM_BAD_BASIS);
    Asked const nowhere(solved.basis, mesh, n, nullptr, nullptr, nullptr, nullptr, true);
    CHECK(nowhere.status == HM_BAD_ARGUMENT);
    for (Asked const* one : {&foreign, &nowhere})
        CHECK(std::count(one->cells.begin(), one->cells.end(), behind) == std::ptrdiff_t(n));
    Numbers x = setup.mesh.x, y = setup.mesh.y, still(x.size(), 0.0);
    hm_points const at{x.data(), y.data(), 1}, by{still.data(), still.data(), 1};
    auto report = sized<hm_quality_report>();
    auto const refused = [&](double* array, const char* other) {
        hm_error error;
        report.cell_quality = array;
        report.inverted = 77;
        CHECK(hm_assess(solved.basis, &mesh, &at, &by, &at, nullptr, nullptr, &report, &error) ==
              HM_BAD_ARGUMENT);
        CHECK(std::string(error.text).find("quality.cell_quality") != std::string::npos);
        CHECK(std::string(error.text).find(other) != std::string::npos);
        CHECK(report.inverted == 77);
        CHECK(x == setup.mesh.x);
        CHECK(std::count(still.begin(), still.end(), 0.0) == std::ptrdiff_t(still.size()));
    };
    refused(x.data() + 1, "from");
    refused(still.data() + still.size() - 1, "displacement");
}

TEST_CASE("the first layer of each wall point: what a known movement does to it") {
    Case setup = airfoil_case(30, 10, Cells::quads);
    Attempt attempt;
    hm_problem problem = setup.problem();
    REQUIRE(attempt.analyse(problem));
    std::int32_t const marker = body;
    std::size_t bytes = 0;
    REQUIRE(fixtures::walls_size(attempt.analysis, 1, &marker, &bytes, nullptr) == HM_OK);
    Guarded block(bytes);
    hm_walls* walls = nullptr;
    REQUIRE(hm_walls_init(&walls, fixtures::Memory(block.data(), bytes), attempt.analysis, 1,
                          &marker, nullptr, nullptr) == HM_OK);
    auto info = sized<hm_walls_info>();
    REQUIRE(hm_walls_info_get(walls, &info, nullptr) == HM_OK);
    std::size_t const n = std::size_t(info.n_wall_points);
    Mesh const& mesh = setup.mesh;
    hm_points const before{mesh.x.data(), mesh.y.data(), 1};
    // Rotation and scale: every height grows by the scale, no angle changes.
    Numbers x = mesh.x, y = mesh.y;
    double const scale = 1.7, c = scale * std::cos(0.8), s = scale * std::sin(0.8);
    for (std::size_t k = 0; k < x.size(); ++k) {
        x[k] = c * mesh.x[k] - s * mesh.y[k];
        y[k] = s * mesh.x[k] + c * mesh.y[k];
    }
    hm_points const turned{x.data(), y.data(), 1};
    Numbers heights(n), later(n), ratios(n), angles(n), alone(n);
    REQUIRE(hm_first_layer(walls, nullptr, &before, heights.data(), nullptr, nullptr, nullptr) ==
            HM_OK);
    REQUIRE(hm_first_layer(walls, &before, &turned, later.data(), ratios.data(), angles.data(),
                           nullptr) == HM_OK);
    for (std::size_t k = 0; k < n; ++k) {
        CHECK(ratios[k] == doctest::Approx(scale).epsilon(1e-10));
        CHECK(angles[k] < 1e-5);  // [degrees], the arc cosine of nearly 1
        CHECK(later[k] == doctest::Approx(scale * heights[k]).epsilon(1e-10));
    }
    // The other ends of the edges go around their wall points, and away from them; walls stay.
    x = mesh.x;
    y = mesh.y;
    for (std::size_t k = 0; k < n; ++k) {
        if (info.layer_points[k] < 0) continue;
        std::size_t const foot = std::size_t(info.wall_points[k]),
                          top = std::size_t(info.layer_points[k]);
        double const dx = mesh.x[top] - mesh.x[foot], dy = mesh.y[top] - mesh.y[foot];
        double const angle = 10 * pi / 180;
        x[top] = mesh.x[foot] + std::cos(angle) * dx - std::sin(angle) * dy;
        y[top] = mesh.y[foot] + std::sin(angle) * dx + std::cos(angle) * dy;
    }
    hm_points const bent{x.data(), y.data(), 1};
    REQUIRE(hm_first_layer(walls, &before, &bent, later.data(), ratios.data(), angles.data(),
                           nullptr) == HM_OK);
    REQUIRE(hm_first_layer(walls, &before, &bent, nullptr, nullptr, alone.data(), nullptr) ==
            HM_OK);
    CHECK(same_bits(alone, angles));
    for (std::size_t k = 0; k < n; ++k) {
        CHECK(angles[k] == doctest::Approx(10).epsilon(1e-6));
        CHECK(ratios[k] == doctest::Approx(later[k] / heights[k]).epsilon(1e-9));
    }
    // Refused: nothing is wanted, or nothing to compare with.
    hm_error error;
    CHECK(hm_first_layer(walls, &before, &bent, nullptr, nullptr, nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text).find("nothing is wanted") != std::string::npos);
    CHECK(hm_first_layer(walls, nullptr, &bent, nullptr, alone.data(), nullptr, &error) ==
          HM_BAD_ARGUMENT);
    CHECK(std::string(error.text).find("before is NULL") != std::string::npos);
    CHECK(same_bits(alone, angles));
}
