// Cells in batches, kernel by kernel: the same as looking at one cell after the other.
#include <doctest/doctest.h>

#include <fixtures/core.hpp>
#include <fixtures/kernels.hpp>
#include <fixtures/traps.hpp>

#include <harmorph/morph/assessment.hpp>

#include <cmath>

using namespace fixtures;
using harmorph::Assessment;
using harmorph::Cell;
using harmorph::CellCorners;
using harmorph::CellMeasure;
using harmorph::CellLayout;
using harmorph::CellShape;
using harmorph::Index;
using harmorph::OrientedMesh;
using harmorph::Points;

namespace {

// A grid of 41 x 12 points, moved at random, with cells in one of the layouts; every third cell runs clockwise.
struct Grid {
    static constexpr Index ni = 41, nj = 12;
    std::vector<double> x, y, dx, dy;
    std::vector<Index> triangles, quads, starts, row_points, block_sizes;
    std::vector<std::uint8_t> reversed;
    OrientedMesh cells;

    Grid(CellLayout layout, double noise, double size, unsigned seed) {
        std::mt19937 random(seed);
        auto const any = [&] { return 2 * uniform(random) - 1; };
        for (Index j = 0; j < nj; ++j) {
            for (Index i = 0; i < ni; ++i) {
                x.push_back(i + noise * any());
                y.push_back(j + noise * any());
                dx.push_back(size * any());
                dy.push_back(size * any());
            }
        }
        harmorph::Mesh& mesh = cells.mesh;
        mesh.layout = layout;
        mesh.n_points = ni * nj;
        mesh.ni = ni;
        mesh.nj = nj;
        for (Index j = 0; j + 1 < nj; ++j)
            for (Index i = 0; i + 1 < ni; ++i) add_cell(i + ni * j);
        Index const n_triangles = static_cast<Index>(triangles.size() / 3);
        Index const n_quads = static_cast<Index>(quads.size() / 4);
        starts.push_back(static_cast<Index>(row_points.size()));
        mesh.n_cells = layout == CellLayout::rows ? static_cast<Index>(starts.size()) - 1 : n_triangles + n_quads;
        if (layout == CellLayout::structured) mesh.n_cells = (ni - 1) * (nj - 1);
        mesh.n_quads = n_quads;
        mesh.cell_points = layout == CellLayout::rows    ? row_points.data()
                           : layout == CellLayout::quads ? quads.data()
                                                         : triangles.data();
        mesh.quad_points = quads.data();
        mesh.cell_start = starts.data();
        reversed.assign(static_cast<std::size_t>(mesh.n_cells), 0);
        if (layout != CellLayout::structured) reverse_some(layout);
        cells.reversed = {reversed.data(), reversed.size()};
    }
    // Structured blocks, ni and nj of each. The cells of every second block run clockwise, and some of the last block.
    Grid(std::vector<Index> sizes, double noise, double size, unsigned seed) : block_sizes(std::move(sizes)) {
        std::mt19937 random(seed);
        auto const any = [&] { return 2 * uniform(random) - 1; };
        harmorph::Mesh& mesh = cells.mesh;
        mesh.layout = CellLayout::blocks;
        mesh.n_blocks = static_cast<Index>(block_sizes.size() / 2);
        mesh.block_sizes = block_sizes.data();
        for (Index block = 0; block < mesh.n_blocks; ++block) {
            Index const* const its = mesh.block_sizes + 2 * block;
            bool const clockwise = block % 2 == 1, last = block + 1 == mesh.n_blocks;
            for (Index j = 0; j < its[1]; ++j) {
                for (Index i = 0; i < its[0]; ++i) {
                    x.push_back(i + noise * any());
                    y.push_back((clockwise ? -1 : 1) * j + noise * any());
                    dx.push_back(size * any());
                    dy.push_back(size * any());
                }
            }
            Index const n = (its[0] - 1) * (its[1] - 1);
            for (Index i = 0; i < n; ++i) reversed.push_back(clockwise || (last && i > n / 2 && i % 97 == 0));
            mesh.n_cells += n;
        }
        mesh.n_points = static_cast<Index>(x.size());
        cells.reversed = {reversed.data(), reversed.size()};
    }
    Points points() const { return {x.data(), y.data(), 1}; }
    Points change() const { return {dx.data(), dy.data(), 1}; }

private:
    // As a quadrilateral or as two triangles; among lists of quadrilaterals, some triangles with a repeated point.
    void add_cell(Index p) {
        Index const q[4] = {p, p + 1, p + 1 + ni, p + ni};
        CellLayout const layout = cells.mesh.layout;
        bool const split = p % 3 == 0;
        if (layout == CellLayout::rows) {
            starts.push_back(static_cast<Index>(row_points.size()));
            row_points.insert(row_points.end(), q, q + (split ? 3 : 4));
        } else if (layout == CellLayout::triangles || (layout == CellLayout::mixed && split)) {
            triangles.insert(triangles.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
        } else {
            quads.insert(quads.end(), q, q + 4);
            if (layout == CellLayout::quads && p > 300 && split) quads.back() = q[2];
        }
    }
    void reverse_some(CellLayout layout) {
        auto const turn = [&](Index* first, Index width, Index number) {
            if (number % 3 != 0 || (width == 4 && first[2] == first[3])) return;
            std::reverse(first, first + width);
            reversed[static_cast<std::size_t>(number)] = 1;
        };
        Index const n_triangles = static_cast<Index>(triangles.size() / 3);
        for (Index i = 0; i < n_triangles; ++i) turn(&triangles[3 * static_cast<std::size_t>(i)], 3, i);
        for (std::size_t i = 0; 4 * i < quads.size(); ++i) turn(&quads[4 * i], 4, n_triangles + static_cast<Index>(i));
        for (Index i = 0; layout == CellLayout::rows && i < cells.mesh.n_cells; ++i) {
            Index const begin = starts[static_cast<std::size_t>(i)], end = starts[static_cast<std::size_t>(i) + 1];
            turn(&row_points[static_cast<std::size_t>(begin)], end - begin, i);
        }
    }
};

// One cell after the other, in the ranges in which the library adds.
template <class Add>
Assessment one_by_one(OrientedMesh const& cells, Add const& add) {
    Assessment all;
    for (Index range = 0; range < 16; ++range) {
        Assessment part;
        Index const n = cells.mesh.n_cells;
        for (Index i = n * range / 16; i < n * (range + 1) / 16; ++i) add(i, cells.cell(i), part);
        if (range == 0) all = part;
        else all.merge(part);
    }
    return all;
}

bool same(double a, double b) { return harmorph::bits_of(a) == harmorph::bits_of(b); }

// Of two kernels.
void check_same(harmorph::Quality const& a, harmorph::Quality const& b) {
    CHECK(a.inverted == b.inverted);
    CHECK(a.first_inverted == b.first_inverted);
    CHECK(same(a.min_area, b.min_area));
    CHECK(same(a.min_quality, b.min_quality));
    CHECK(a.min_quality_cell == b.min_quality_cell);
    CHECK(same(a.quality_sum, b.quality_sum));
    CHECK(a.cells == b.cells);
}

// Of a kernel and of cells one by one, whose sum is added up in another order.
void check_equal(harmorph::Quality const& a, harmorph::Quality const& b) {
    CHECK(a.inverted == b.inverted);
    CHECK(a.first_inverted == b.first_inverted);
    CHECK(same(a.min_area, b.min_area));
    CHECK(same(a.min_quality, b.min_quality));
    CHECK(a.min_quality_cell == b.min_quality_cell);
    CHECK(a.quality_sum == doctest::Approx(b.quality_sum).epsilon(1e-14));
    CHECK(a.cells == b.cells);
}

void check_same(harmorph::AdmissibleStep const& a, harmorph::AdmissibleStep const& b) {
    CHECK(same(a.step, b.step));
    CHECK(a.cell == b.cell);
    CHECK(a.corner == b.corner);
}

void check_all(Grid const& grid) {
    OrientedMesh const& cells = grid.cells;
    Points const points = grid.points(), change = grid.change();
    Assessment const assessed = one_by_one(cells, [&](Index i, Cell const& cell, Assessment& to) {
        CellShape const now(cell, points, false), by(cell, change, false);
        CellCorners const corners(now);
        to.limit.add(i, cell.n, corners, CellCorners(by));
        CellShape then = now;
        for (Index k = 0; k < 4; ++k) then.at[k] = now.at[k] + by.at[k];
        to.quality.add(i, CellMeasure(cell.n, CellCorners(then)), corners.cell_area(cell.n));
    });
    Assessment const skew = one_by_one(cells, [&](Index i, Cell const& cell, Assessment& to) {
        to.quality.add(i, CellMeasure(cell.n, CellCorners(CellShape(cell, points, false))), 0);
    });
    Assessment const compared = one_by_one(cells, [&](Index i, Cell const& cell, Assessment& to) {
        to.quality.add(i, CellMeasure(cell.n, CellCorners(CellShape(cell, points, false))), cell_area(cell, change));
    });
    auto const by_kernel = [&](harmorph::Kernel kernel) {
        harmorph::Executor executor;
        executor.kernel = kernel;
        struct {
            Assessment assessed;
            harmorph::AdmissibleStep limit;
            harmorph::Quality skew, compared;
        } found{harmorph::assess(cells, points, change, executor),
                harmorph::admissible_step(cells, points, change, executor),
                harmorph::measure_quality(cells, points, {}, executor),
                harmorph::measure_quality(cells, points, change, executor)};
        return found;
    };
    auto const first = by_kernel(harmorph::Kernel::baseline);
    check_same(first.limit, assessed.limit);
    check_equal(first.assessed.quality, assessed.quality);
    check_equal(first.skew, skew.quality);
    check_equal(first.compared, compared.quality);
    for (harmorph::Kernel const kernel : usable_kernels()) {
        auto const found = by_kernel(kernel);
        check_same(found.assessed.limit, first.limit);
        check_same(found.limit, first.limit);
        check_same(found.assessed.quality, first.assessed.quality);
        check_same(found.skew, first.skew);
        check_same(found.compared, first.compared);
    }
}

constexpr CellLayout layouts[] = {CellLayout::rows, CellLayout::triangles, CellLayout::quads, CellLayout::structured,
                                  CellLayout::mixed};

}  // namespace

TEST_CASE("batches find what single cells show, in all layouts, valid and inverted") {
    for (CellLayout const layout : layouts) {
        CAPTURE(static_cast<int>(layout));
        for (double const noise : {0.0, 0.2, 0.9}) {  // the last one inverts cells
            for (double const size : {0.0, 1e-3, 0.3, 5.0}) check_all(Grid(layout, noise, size, 7));
        }
    }
}

TEST_CASE("structured blocks: batches run on from row to row and from block to block") {
    for (std::vector<Index> const& sizes : std::vector<std::vector<Index>>{
             {200, 15}, {41, 12, 2, 2, 130, 3, 5, 60, 67, 30}, {2, 700, 2, 700, 66, 17, 2, 2, 2, 2}}) {
        CAPTURE(sizes.size());
        for (double const noise : {0.0, 0.2, 0.9}) {
            for (double const size : {0.0, 1e-3, 0.3, 5.0}) check_all(Grid(sizes, noise, size, 11));
        }
    }
}

TEST_CASE("where no cell limits the step, none is named") {
    Grid grid(CellLayout::mixed, 0.2, 0, 3);
    for (std::size_t i = 0; i < grid.x.size(); ++i) {  // the mesh moves as a whole, and grows
        grid.dx[i] = 2 + grid.x[i];
        grid.dy[i] = 1 + grid.y[i];
    }
    check_all(grid);
    harmorph::AdmissibleStep const limit = harmorph::admissible_step(grid.cells, grid.points(), grid.change(), {});
    CHECK(limit.step == harmorph::infinity);
    CHECK(limit.cell == harmorph::none);
}

TEST_CASE("turns and waves, in which areas fall and rise again, are limited as single cells are") {
    for (CellLayout const layout : layouts) {
        CAPTURE(static_cast<int>(layout));
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

TEST_CASE("numbers that are not finite are found as they are in single cells") {
    Untrapped const untrapped;
    for (CellLayout const layout : layouts) {
        CAPTURE(static_cast<int>(layout));
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
        CAPTURE(static_cast<int>(layout));
        Grid grid(layout, 0.2, 0.02, 5);
        Assessment const usual = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
        double length = 1;
        for (double const unit : {1e-90, 1e-30, 1e-21, 1e24, 1e70}) {  // of areas between 1e-180 and 1e140
            for (std::vector<double>* const numbers : {&grid.x, &grid.y, &grid.dx, &grid.dy})
                for (double& number : *numbers) number *= unit / length;
            length = unit;
            check_all(grid);
            Assessment const found = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
            CHECK(found.limit.step == doctest::Approx(usual.limit.step).epsilon(1e-12));
            CHECK(found.quality.inverted == 0);
            CHECK(found.quality.min_quality == doctest::Approx(usual.quality.min_quality).epsilon(1e-12));
            CHECK(found.quality.quality_sum == doctest::Approx(usual.quality.quality_sum).epsilon(1e-12));
        }
    }
}

// As Fortran's xy(2, n) has them.
std::vector<double> in_pairs(std::vector<double> const& x, std::vector<double> const& y) {
    std::vector<double> pairs;
    for (std::size_t i = 0; i < x.size(); ++i) pairs.insert(pairs.end(), {x[i], y[i]});
    return pairs;
}

TEST_CASE("points or displacements in pairs give the bits of points in two arrays, in all layouts") {
    for (CellLayout const layout : layouts) {
        CAPTURE(static_cast<int>(layout));
        Grid const grid(layout, 0.2, 0.3, 11);
        std::vector<double> const pairs = in_pairs(grid.x, grid.y), changes = in_pairs(grid.dx, grid.dy);
        Points const at = {pairs.data(), pairs.data() + 1, 2}, by = {changes.data(), changes.data() + 1, 2};
        for (harmorph::Kernel const kernel : usable_kernels()) {
            harmorph::Executor executor;
            executor.kernel = kernel;
            Assessment const apart = harmorph::assess(grid.cells, grid.points(), grid.change(), executor);
            harmorph::Quality const skew = harmorph::measure_quality(grid.cells, grid.points(), {}, executor);
            for (Points const points : {at, grid.points()}) {
                for (Points const change : {by, grid.change()}) {
                    Assessment const found = harmorph::assess(grid.cells, points, change, executor);
                    check_same(found.limit, apart.limit);
                    check_same(found.quality, apart.quality);
                }
                check_same(harmorph::measure_quality(grid.cells, points, {}, executor), skew);
            }
        }
    }
}

TEST_CASE("lists of any number of cells, in steps of eight and not, are looked at to the last one") {
    for (CellLayout const layout : {CellLayout::rows, CellLayout::triangles, CellLayout::quads}) {
        CAPTURE(static_cast<int>(layout));
        for (Index n = 1; n <= 40; ++n) {
            CAPTURE(n);
            Grid grid(layout, 0.3, 0.3, 17);
            grid.cells.mesh.n_cells = n;
            check_all(grid);
        }
    }
}

TEST_CASE("cells whose index base is 1 are the same cells") {
    for (CellLayout const layout : {CellLayout::rows, CellLayout::triangles, CellLayout::quads, CellLayout::mixed}) {
        CAPTURE(static_cast<int>(layout));
        Grid grid(layout, 0.2, 0.3, 13);
        Assessment const from_zero = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
        for (std::vector<Index>* const list : {&grid.triangles, &grid.quads, &grid.row_points, &grid.starts})
            for (Index& index : *list) ++index;
        grid.cells.mesh.index_base = 1;
        check_all(grid);
        Assessment const from_one = harmorph::assess(grid.cells, grid.points(), grid.change(), {});
        check_same(from_one.limit, from_zero.limit);
        check_same(from_one.quality, from_zero.quality);
    }
}

TEST_CASE("cells that are compared with cells without an area have their skew quality") {
    for (CellLayout const layout : layouts) {
        CAPTURE(static_cast<int>(layout));
        Grid const grid(layout, 0.2, 0, 19);
        for (harmorph::Kernel const kernel : usable_kernels()) {
            harmorph::Executor executor;
            executor.kernel = kernel;
            harmorph::Quality const skew = harmorph::measure_quality(grid.cells, grid.points(), {}, executor);
            Points const at = grid.points();
            check_equal(harmorph::measure_quality(grid.cells, at, grid.change(), executor), skew);
            harmorph::Quality const unmoved = harmorph::measure_quality(grid.cells, at, at, executor);
            CHECK(unmoved.min_quality == doctest::Approx(skew.min_quality).epsilon(1e-14));
            CHECK(unmoved.quality_sum == doctest::Approx(skew.quality_sum).epsilon(1e-14));
        }
    }
}

TEST_CASE("inverted cells are counted exactly, needles and flat cells among them") {
    for (CellLayout const layout : layouts) {
        CAPTURE(static_cast<int>(layout));
        for (double const height : {1.0, 1e-6, 1e-9, 1e-12, 1e-15, 1e-17, 0.0}) {  // of the cells
            CAPTURE(height);
            for (double const noise : {0.0, 0.3, 0.9}) {
                Grid grid(layout, noise, 0, 29);
                for (std::size_t i = 0; i < grid.x.size(); ++i) grid.y[i] = height * grid.y[i] + 0.1 * grid.x[i];
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
                    CHECK(harmorph::count_inverted(grid.cells, grid.points(), executor) == expected);
                }
            }
        }
    }
}
