// Coarse levels of control volumes: every level is a partition of connected volumes, and
// directional merging follows thin cells. The kind `fields` of tests/fuzz compares areas and
// increases of areas with sums in more digits.
#include <harmorph_fields.h>
#include <doctest/doctest.h>

#include <fixtures/bodies.hpp>
#include <fixtures/core.hpp>
#include <fixtures/naca0012.hpp>
#include <fixtures/polygons.hpp>

#include <cmath>
#include <set>
#include <string>

using namespace fixtures;

namespace {

struct LevelSet {
    Mesh mesh;
    Analysed analysed;
    std::unique_ptr<Guarded> block;
    hm_levels* levels = nullptr;
    std::int32_t n_levels = 0;

    LevelSet(Mesh const& given, std::int32_t agglomeration, std::int32_t max_levels = 0)
        : mesh(given), analysed(mesh) {
        std::size_t bytes = 0;
        REQUIRE(hm_levels_size(analysed.analysis, &bytes, nullptr) == HM_OK);
        block = std::make_unique<Guarded>(bytes, 0);
        CHECK(hm_levels_init(&levels, block->data(), bytes - 1, analysed.analysis, nullptr,
                             agglomeration, max_levels, nullptr) == HM_BLOCK_TOO_SMALL);
        REQUIRE(hm_levels_init(&levels, block->data(), bytes, analysed.analysis, nullptr,
                               agglomeration, max_levels, nullptr) == HM_OK);
        REQUIRE(hm_level_cells(levels, 0, nullptr, nullptr, &n_levels, nullptr) == HM_OK);
    }
    std::vector<std::int32_t> cells(std::int32_t level, std::int32_t& n) const {
        std::vector<std::int32_t> out(mesh.x.size());
        REQUIRE(hm_level_cells(levels, level, out.data(), &n, nullptr, nullptr) == HM_OK);
        return out;
    }
};

std::set<Edge> edges_of(Mesh const& mesh) {
    std::set<Edge> out;
    for (std::size_t i = 0; i + 1 < mesh.cell_start.size(); ++i) {
        std::int32_t const begin = mesh.cell_start[i], end = mesh.cell_start[i + 1];
        for (std::int32_t k = begin; k < end; ++k) {
            std::int32_t const
                a = mesh.cells[static_cast<std::size_t>(k)],
                b = mesh.cells[static_cast<std::size_t>(k + 1 == end ? begin : k + 1)];
            out.insert({std::min(a, b), std::max(a, b)});
        }
    }
    return out;
}

// Counts the connected sets of points with equal numbers.
int count_connected(Mesh const& mesh, std::vector<std::int32_t> const& cell) {
    std::vector<std::int32_t> root(cell.size());
    for (std::size_t k = 0; k < root.size(); ++k) root[k] = static_cast<std::int32_t>(k);
    auto const find = [&](std::int32_t k) {
        while (root[static_cast<std::size_t>(k)] != k) k = root[static_cast<std::size_t>(k)];
        return k;
    };
    for (Edge const& edge : edges_of(mesh)) {
        if (cell[static_cast<std::size_t>(edge.first)] !=
            cell[static_cast<std::size_t>(edge.second)])
            continue;
        root[static_cast<std::size_t>(find(edge.first))] = find(edge.second);
    }
    int n = 0;
    for (std::size_t k = 0; k < root.size(); ++k) n += root[k] == static_cast<std::int32_t>(k);
    return n;
}

std::vector<double> areas_of(LevelSet const& set, std::int32_t level, hm_points const& to,
                             const hm_points* from = nullptr) {
    std::int32_t n = 0;
    set.cells(level, n);
    std::vector<double> areas(static_cast<std::size_t>(n));
    REQUIRE(hm_level_areas(set.levels, level, from, &to, areas.data(), nullptr) == HM_OK);
    return areas;
}

}  // namespace

TEST_CASE("levels are nested partitions of connected volumes, at most a third as many each") {
    for (std::int32_t merging = HM_AGGLOMERATE_AUTO; merging <= HM_AGGLOMERATE_DIRECTIONAL;
         ++merging) {
        for (int kind = 0; kind < 3; ++kind) {
            CAPTURE(merging);
            CAPTURE(kind);
            LevelSet const set(kind == 0 ? naca0012_viscous(3000)
                               : kind == 1
                                   ? two_bodies(40, 20, {}, Ellipse{0.25, 0.06, 0.4}, Cells::hybrid)
                                   : naca0012_triangles(2000),
                               merging);
            CHECK(set.n_levels >= 3);
            std::int32_t n_before = 0;
            std::vector<std::int32_t> before = set.cells(0, n_before);
            CHECK(n_before == set.mesh.n_points());
            for (std::int32_t level = 1; level < set.n_levels; ++level) {
                std::int32_t n = 0;
                std::vector<std::int32_t> const cell = set.cells(level, n);
                CHECK(3 * n <= n_before);
                CHECK(count_connected(set.mesh, cell) == n);
                std::vector<std::int32_t> parent(static_cast<std::size_t>(n_before), -1);
                int torn = 0;
                for (std::size_t k = 0; k < cell.size(); ++k) {
                    std::int32_t& own = parent[static_cast<std::size_t>(before[k])];
                    if (own != -1 && own != cell[k]) ++torn;
                    own = cell[k];
                }
                CHECK(torn == 0);
                before = cell;
                n_before = n;
            }
        }
    }
}

TEST_CASE("directional merging joins points across thin layers, isotropic merging does not care") {
    // A grid of thin quadrilaterals: points above each other are much nearer than others.
    Mesh grid;
    int const ni = 30, nj = 30;
    for (int j = 0; j < nj; ++j)
        for (int i = 0; i < ni; ++i) grid.add_point({1.0 * i, 1e-3 * j});
    for (int j = 0; j + 1 < nj; ++j) {
        for (int i = 0; i + 1 < ni; ++i) {
            std::int32_t const a = i + ni * j;
            grid.add_cell({a, a + 1, a + 1 + ni, a + ni});
        }
    }
    for (int i = 0; i + 1 < ni; ++i) {
        grid.add_face(i, i + 1, body);
        grid.add_face((nj - 1) * ni + i + 1, (nj - 1) * ni + i, far_field);
    }
    for (int j = 0; j + 1 < nj; ++j) {
        grid.add_face((j + 1) * ni, j * ni, far_field);
        grid.add_face((j + 1) * ni - 1, (j + 2) * ni - 1, far_field);
    }
    auto const along_layers = [&](std::int32_t merging) {
        LevelSet const set(grid, merging);
        std::int32_t n = 0;
        std::vector<std::int32_t> const cell = set.cells(1, n);
        int joined = 0;
        for (std::size_t k = 0; k + 1 < cell.size(); ++k)
            joined += (k + 1) % static_cast<std::size_t>(ni) != 0 && cell[k] == cell[k + 1];
        return joined;
    };
    CHECK(along_layers(HM_AGGLOMERATE_DIRECTIONAL) == 0);
    CHECK(along_layers(HM_AGGLOMERATE_ISOTROPIC) > 100);
}

TEST_CASE("polygons, a bound of levels, refused levels") {
    Mesh polygons = honeycomb(12, 40, 1, 3);
    polygons.cell_layout = HM_CELLS_POLYGONS;
    LevelSet const set(polygons, HM_AGGLOMERATE_AUTO, 2);
    CHECK(set.n_levels == 2);
    hm_points const at = {set.mesh.x.data(), set.mesh.y.data(), 1};
    std::vector<double> const areas = areas_of(set, 1, at);
    hm_error error;
    std::vector<double> out(areas.size());
    CHECK(hm_level_areas(set.levels, 2, nullptr, &at, out.data(), &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) == "there is no level 2; the mesh has 2 levels");
    hm_levels* levels = nullptr;
    std::size_t bytes = 0;
    REQUIRE(hm_levels_size(set.analysed.analysis, &bytes, nullptr) == HM_OK);
    Guarded block(bytes, 0);
    CHECK(hm_levels_init(&levels, block.data(), bytes, set.analysed.analysis, nullptr, 3, 0,
                         &error) == HM_BAD_ARGUMENT);
    CHECK(std::string(error.text) ==
          "agglomeration is 3 and max_levels is 0; agglomeration must be 0 to 2, and max_levels 0 "
          "to 20");
    CHECK(hm_levels_init(&levels, block.data(), bytes, set.analysed.analysis, nullptr, 0, 21,
                         &error) == HM_BAD_ARGUMENT);
    CHECK(levels == nullptr);
}
