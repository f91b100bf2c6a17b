// The region round chosen cells, against distances counted the slow way.
#include <fixtures/core.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/mesh.hpp>
#include <fixtures/guarded.hpp>

#include "base/executor.hpp"
#include "safe/region.hpp"

#include <set>

using namespace fixtures;
using harmorph::Index;
using harmorph::Region;

namespace {

struct Grown {
    Mesh mesh;
    harmorph::Mesh view;
    std::vector<std::uint8_t> held;
    Analysed analysed;
    std::unique_ptr<Guarded> block;
    harmorph::Tangle tangle;
    Region region;

    explicit Grown(Mesh const& given_mesh)
        : mesh(given_mesh), view(core_mesh(mesh)), held(mesh.x.size(), 0), analysed(mesh) {
        for (std::int32_t const point : mesh.faces) held[std::size_t(point)] = 1;
        auto const counts = harmorph::RegionCounts::of(analysed->topology());
        block = laid_out_part(region, counts);
        tangle = {view, view.points, analysed->topology().reversed,
                  analysed->topology().representative, span(held)};
        region.link(tangle);
    }
    std::set<Index> corners(Index cell) const {
        harmorph::Cell const one = view.cell(cell);
        return {one.point, one.point + one.n};
    }
    // Points within `layers` cells of a cell.
    std::set<Index> near(Index cell, int layers) const {
        std::set<Index> out = corners(cell);
        for (int layer = 0; layer < layers; ++layer) {
            std::set<Index> const before = out;
            for (Index i = 0; i < view.n_cells; ++i) {
                std::set<Index> const around = corners(i);
                bool touches = false;
                for (Index const point : around) touches = touches || before.count(point) != 0;
                if (touches) out.insert(around.begin(), around.end());
            }
        }
        return out;
    }
};

Mesh numbered_anyhow(int n) {
    Mesh mesh = square(n, Cells::hybrid, 2, 2);
    add_unused(mesh, 3, 4);
    shuffle_cells(mesh, 5);
    reverse_some(mesh, 6);
    return mesh;
}

Index range_of(Index n, Index u) {
    Index range = 0;
    while (u >= harmorph::range_start(n, range + 1)) ++range;
    return range;
}

}  // namespace

TEST_CASE("the unknowns are the free points within the given number of cells") {
    Grown grown(numbered_anyhow(12));
    for (Index const seed : {3, 60, 140})
        for (int const layers : {1, 2, 4, 300}) {
            grown.region.choose([&](Index cell) { return cell == seed; });
            grown.region.grow(grown.tangle, layers);
            std::set<Index> wanted;
            for (Index const point : grown.near(seed, layers < 300 ? layers : 40))
                if (grown.held[std::size_t(point)] == 0) wanted.insert(point);
            Region const& region = grown.region;
            CHECK(std::set<Index>(region.point.begin(), region.point.begin() + region.n) == wanted);
            for (Index u = 0; u < region.n; ++u) CHECK(region.unknown[region.point[u]] == u);

            std::set<Index> cells;
            std::vector<std::set<Index>> neighbours(std::size_t(region.n));
            for (Index i = 0; i < grown.view.n_cells; ++i)
                for (Index const a : grown.corners(i)) {
                    if (region.unknown[a] == harmorph::none) continue;
                    cells.insert(i);
                    for (Index const b : grown.corners(i)) {
                        Index const v = region.unknown[b];
                        if (v != harmorph::none)
                            neighbours[std::size_t(region.unknown[a])].insert(v);
                    }
                }
            CHECK(region.n_cells == Index(cells.size()));
            CHECK(std::set<Index>(region.cell.begin(), region.cell.begin() + region.n_cells) ==
                  cells);
            std::vector<std::set<Index>> listed(std::size_t(region.n));
            for (Index u = 0; u < region.n; ++u) {
                auto const row = region.of(u);
                CHECK(row[0] == u);
                CHECK(std::set<Index>(row.begin(), row.end()).size() == row.size());
                for (Index k = 0; k < row.count(); ++k) {
                    bool const is_inner = region.start[u] + k < region.outer_start[u];
                    CHECK((range_of(region.n, row[k]) == range_of(region.n, u)) == is_inner);
                    CHECK((!is_inner || row[k] >= u));
                    listed[std::size_t(u)].insert(row[k]);
                    if (is_inner) listed[std::size_t(row[k])].insert(u);
                }
            }
            CHECK(listed == neighbours);
        }
}

TEST_CASE("the whole mesh fills the memory of the pairs exactly when no point is held") {
    Grown grown(numbered_anyhow(8));
    std::fill(grown.held.begin(), grown.held.end(), std::uint8_t{0});
    grown.region.choose([](Index) { return false; });
    grown.region.grow(grown.tangle, Region::whole);
    CHECK(grown.region.n == grown.mesh.n_points() - 3);
    CHECK(grown.region.n_cells == grown.view.n_cells);
    Index n_inner = 0;  // pairs that are listed once
    for (Index u = 0; u < grown.region.n; ++u) {
        n_inner += Index(grown.region.outer_start[u] - grown.region.start[u]) - 1;
    }
    CHECK(grown.region.start[grown.region.n] + n_inner ==
          grown.region.neighbour.count() - 3);  // less unused points
}

TEST_CASE("cells are kept in order") {
    Grown grown(numbered_anyhow(6));
    grown.region.choose([](Index cell) { return cell % 2 == 0; });
    CHECK(grown.region.n_cells == (grown.view.n_cells + 1) / 2);
    grown.region.keep([](Index cell) { return cell % 3 == 0; });
    for (Index k = 0; k < grown.region.n_cells; ++k) CHECK(grown.region.cell[k] == 6 * k);
    CHECK(grown.region.n_cells == (grown.view.n_cells + 5) / 6);
}
