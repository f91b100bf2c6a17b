#include "morph/assessment.hpp"

#include "base/parallel_reduce.hpp"

namespace harmorph {

Quality displaced_quality(OrientedMesh const& cells, Points points, Points displacement,
                          Points reference, Executor const& executor) noexcept {
    auto const moved = [&](Index piece) {
        CellShape shape = shape_of(cells, piece, points);
        CellShape const change = shape_of(cells, piece, displacement);
        for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + change.at[k];
        return shape;
    };
    auto const measure = [&](Index cell) {
        if (cells.mesh.is_of_pieces()) return CellMeasure(cells.mesh, cell, moved);
        CellShape const shape = moved(cell);
        return CellMeasure(shape.n, CellCorners(shape));
    };
    Index const n_cells = cells.mesh.n_given_cells();
    return reduce_cells<Quality>(n_cells, executor, [&](Index cell, Quality& quality) {
        quality.add(cell, measure(cell), measure_cell(cells, cell, reference).area);
    });
}

Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor) noexcept {
    if (cells.mesh.is_of_pieces()) {
        return {admissible_step(cells, points, displacement, executor),
                displaced_quality(cells, points, displacement, points, executor)};
    }
    CellKernels const& kernels = cell_kernels(executor.kernel, cells.mesh.n_cells);
    CellPlaces const places{points, displacement, {}};
    return reduce_ranges<Assessment>(
        cells.mesh.n_cells, executor, [&](Index begin, Index end, Assessment& result) {
            Assessment assessment;
            for_each_batch(cells, begin, end, [&](CellBatches const& batches) {
                Quality& quality = assessment.quality;
                CellBounds const bounds = {assessment.limit.step, 2 * quality.min_area,
                                           quality.min_quality};
                ListQuality in_triangles, in_quads;
                std::uint64_t const triangles =
                    kernels.triangles(batches.triangles, places, bounds, &in_triangles);
                std::uint64_t const quads = kernels.quads(batches.quads, places, bounds, &in_quads);
                assessment.limit.add(cells, places, batches, triangles, quads);
                quality.add(cells, places, batches, in_triangles, in_quads);
            });
            result = assessment;
        });
}

}  // namespace harmorph
