#include "harmorph/morph/quality.hpp"

#include "harmorph/base/parallel_reduce.hpp"

namespace harmorph {

void Quality::merge(Quality const& later) noexcept {
    if (inverted == 0) first_inverted = later.first_inverted;
    inverted += later.inverted;
    min_area = smaller(min_area, later.min_area);
    if (later.min_quality < min_quality) {
        min_quality = later.min_quality;
        min_quality_cell = later.min_quality_cell;
    }
    quality_sum += later.quality_sum;
    cells += later.cells;
}

void Quality::add(CellBatches const& batches, BatchQuality const& triangles, BatchQuality const& quads) noexcept {
    batches.for_each([&](Index cell, bool is_triangle, Index i) {
        BatchQuality const& its = is_triangle ? triangles : quads;
        add(cell, its.twice_smallest[i], its.quality[i]);
    });
}

CellMeasure measure_cell(OrientedMesh const& cells, Index number, Points points) noexcept {
    auto const shape_at = [&](Index i) { return shape_of(cells, i, points); };
    if (cells.mesh.is_of_pieces()) return {cells.mesh, number, shape_at};
    CellShape const shape = shape_at(number);
    return {shape.n, CellCorners(shape)};
}

Quality measure_quality(OrientedMesh const& cells, Points points, Points reference,
                        Executor const& executor) noexcept {
    if (cells.mesh.is_of_pieces()) {
        return reduce_cells<Quality>(cells.mesh.n_given, executor, [&](Index i, Quality& quality) {
            quality.add(i, measure_cell(cells, i, points),
                        reference.given() ? measure_cell(cells, i, reference).area : 0);
        });
    }
    CellKernels const& kernels = cell_kernels(executor.kernel, cells.mesh.n_cells);
    CellPlaces const places{points, {}, reference};
    return reduce_ranges<Quality>(cells.mesh.n_cells, executor, [&](Index begin, Index end, Quality& result) {
        Quality quality;
        for_each_batch(cells, begin, end, [&](CellBatches const& batches) {
            BatchQuality triangles, quads;
            kernels.triangles(batches.triangles, places, 0, &triangles);
            kernels.quads(batches.quads, places, 0, &quads);
            quality.add(batches, triangles, quads);
        });
        result = quality;
    });
}

}  // namespace harmorph
