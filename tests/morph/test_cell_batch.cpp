// Cells in batches, kernel by kernel: the same as looking at one cell after the other.
#include <doctest/doctest.h>

#include <fixtures/cell_grid.hpp>

#include <cmath>

using namespace fixtures;
using namespace fixtures::cell_grid;

TEST_CASE("batches find what single cells show, in all layouts, valid and inverted") {
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        for (double const noise : {0.0, 0.2, 0.9}) {  // the last one inverts cells
            for (double const size : {0.0, 1e-3, 0.3, 5.0}) check_all(Grid(layout, noise, size, 7));
        }
    }
}

TEST_CASE("structured blocks: batches run on from row to row and from block to block") {
    for (std::vector<Index> const& sizes :
         std::vector<std::vector<Index>>{{200, 15},
                                         {41, 12, 2, 2, 130, 3, 5, 60, 67, 30},
                                         {2, 700, 2, 700, 66, 17, 2, 2, 2, 2}}) {
        CAPTURE(sizes.size());
        for (double const noise : {0.0, 0.2, 0.9}) {
            for (double const size : {0.0, 1e-3, 0.3, 5.0}) check_all(Grid(sizes, noise, size, 11));
        }
    }
}

TEST_CASE("turns and waves, in which areas fall and rise again, are limited as single cells are") {
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        for (double const turn : {0.0, 1e-3, 1.0}) {
            for (double const wave : {0.0, 1e-3, 0.5}) {
                Grid grid(layout, 0.2, 0, 3);
                for (std::size_t i = 0; i < grid.x.size(); ++i) {
                    grid.dx[i] = -turn * grid.y[i] + wave * std::sin(grid.x[i]);
                    grid.dy[i] = turn * grid.x[i] + wave * std::cos(grid.y[i]);
                }
                check_all(grid);
            }
        }
    }
}

// The coordinates alternate as in an array xy(2, n) of Fortran.
std::vector<double> in_pairs(std::vector<double> const& x, std::vector<double> const& y) {
    std::vector<double> pairs;
    for (std::size_t i = 0; i < x.size(); ++i) pairs.insert(pairs.end(), {x[i], y[i]});
    return pairs;
}

TEST_CASE("points in pairs give the bits of points in two arrays in all layouts") {
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        Grid const grid(layout, 0.2, 0.3, 11);
        std::vector<double> const pairs = in_pairs(grid.x, grid.y),
                                  changes = in_pairs(grid.dx, grid.dy);
        Points const at = {pairs.data(), pairs.data() + 1, 2},
                     by = {changes.data(), changes.data() + 1, 2};
        for (harmorph::Kernel const kernel : usable_kernels()) {
            harmorph::Executor executor;
            executor.kernel = kernel;
            Assessment const apart =
                harmorph::assess(grid.cells, grid.points(), grid.change(), executor);
            harmorph::Quality const skew =
                harmorph::measure_quality(grid.cells, grid.points(), {}, executor);
            for (Points const points : {at, grid.points()}) {
                for (Points const change : {by, grid.change()}) {
                    Assessment const found = harmorph::assess(grid.cells, points, change, executor);
                    check_same(found.limit, apart.limit);
                    check_same(found.quality, apart.quality);
                    Assessment const without_step =
                        harmorph::assess(grid.cells, points, change, executor, false);
                    check_same(without_step.quality, apart.quality);
                }
                check_same(harmorph::measure_quality(grid.cells, points, {}, executor), skew);
            }
        }
    }
}

TEST_CASE("lists of any number of cells are examined to the last cell") {
    for (CellLayout const layout : {CellLayout::rows, CellLayout::triangles, CellLayout::quads}) {
        CAPTURE(int(layout));
        for (Index n = 1; n <= 40; ++n) {
            CAPTURE(n);
            Grid grid(layout, 0.3, 0.3, 17);
            grid.cells.mesh.n_cells = n;
            check_all(grid);
        }
    }
}

TEST_CASE("cells whose index base is 1 are the same cells") {
    for (CellLayout const layout :
         {CellLayout::rows, CellLayout::triangles, CellLayout::quads, CellLayout::mixed}) {
        CAPTURE(int(layout));
        Grid grid(layout, 0.2, 0.3, 13);
        Assessment const from_zero = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
        for (std::vector<Index>* const list :
             {&grid.triangles, &grid.quads, &grid.row_points, &grid.starts})
            for (Index& index : *list) ++index;
        grid.cells.mesh.index_base = 1;
        check_all(grid);
        Assessment const from_one = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
        check_same(from_one.limit, from_zero.limit);
        check_same(from_one.quality, from_zero.quality);
    }
}
