// Cells in batches where numbers are extreme: not finite, of any size, flat, inverted, without an
// area or a limit.
#include <doctest/doctest.h>

#include <fixtures/cell_grid.hpp>
#include <fixtures/traps.hpp>

#include <cmath>

using namespace fixtures;
using namespace fixtures::cell_grid;

TEST_CASE("where no cell limits the step, none is named") {
    Grid grid(CellLayout::mixed, 0.2, 0, 3);
    for (std::size_t i = 0; i < grid.x.size(); ++i) {  // the mesh moves as a whole, and grows
        grid.dx[i] = 2 + grid.x[i];
        grid.dy[i] = 1 + grid.y[i];
    }
    check_all(grid);
    harmorph::AdmissibleStep const limit =
        harmorph::admissible_step(grid.cells, grid.points(), grid.change(), {});
    CHECK(limit.step == harmorph::infinity);
    CHECK(limit.cell == harmorph::none);
}

TEST_CASE("numbers that are not finite are found as they are in single cells") {
    Untrapped const untrapped;
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        for (double const bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
            for (std::size_t const point : {0u, 100u, 491u}) {
                Grid moved(layout, 0.1, 0.1, 5), displaced(layout, 0.1, 0.1, 5);
                moved.x[point] = bad;
                displaced.dy[point] = bad;
                check_all(moved);
                check_all(displaced);
            }
        }
    }
}

TEST_CASE("cells of any size have the quality of the same cells in other units") {
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        Grid grid(layout, 0.2, 0.02, 5);
        Assessment const usual = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
        double length = 1;
        for (double const unit :
             {1e-90, 1e-30, 1e-21, 1e24, 1e70}) {  // of areas between 1e-180 and 1e140
            for (std::vector<double>* const numbers : {&grid.x, &grid.y, &grid.dx, &grid.dy})
                for (double& number : *numbers) number *= unit / length;
            length = unit;
            check_all(grid);
            Assessment const found = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
            CHECK(found.limit.step == doctest::Approx(usual.limit.step).epsilon(1e-12));
            CHECK(found.quality.inverted == 0);
            CHECK(found.quality.min_quality ==
                  doctest::Approx(usual.quality.min_quality).epsilon(1e-12));
            CHECK(found.quality.quality_sum ==
                  doctest::Approx(usual.quality.quality_sum).epsilon(1e-12));
        }
    }
}

TEST_CASE("cells that are compared with cells without an area have their skew quality") {
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        Grid const grid(layout, 0.2, 0, 19);
        for (harmorph::Kernel const kernel : usable_kernels()) {
            harmorph::Executor executor;
            executor.kernel = kernel;
            harmorph::Quality const skew =
                harmorph::measure_quality(grid.cells, grid.points(), {}, executor);
            Points const at = grid.points();
            check_equal(harmorph::measure_quality(grid.cells, at, grid.change(), executor), skew);
            harmorph::Quality const unmoved =
                harmorph::measure_quality(grid.cells, at, at, executor);
            CHECK(unmoved.min_quality == doctest::Approx(skew.min_quality).epsilon(1e-14));
            CHECK(unmoved.quality_sum == doctest::Approx(skew.quality_sum).epsilon(1e-14));
        }
    }
}

TEST_CASE("inverted cells are counted exactly, needles and flat cells among them") {
    for (CellLayout const layout : layouts) {
        CAPTURE(int(layout));
        for (double const height : {1.0, 1e-6, 1e-9, 1e-12, 1e-15, 1e-17, 0.0}) {  // of the cells
            CAPTURE(height);
            for (double const noise : {0.0, 0.3, 0.9}) {
                Grid grid(layout, noise, 0, 29);
                for (std::size_t i = 0; i < grid.x.size(); ++i)
                    grid.y[i] = height * grid.y[i] + 0.1 * grid.x[i];
                Index expected = 0;
                for (Index i = 0; i < grid.cells.mesh.n_cells; ++i) {
                    CellShape const shape(grid.cells.cell(i), grid.points(), false);
                    expected += is_inverted(shape) || is_inverted_exactly(shape) ? 1 : 0;
                }
                if (height == 1 && noise == 0) CHECK(expected == 0);
                if (height == 0) CHECK(expected > 0);
                for (harmorph::Kernel const kernel : usable_kernels()) {
                    harmorph::Executor executor;
                    executor.kernel = kernel;
                    CHECK(harmorph::count_inverted(grid.cells, grid.points(), executor) ==
                          expected);
                }
            }
        }
    }
}
