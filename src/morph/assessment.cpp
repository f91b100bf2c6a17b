#include "morph/assessment.hpp"

#include "base/parallel_reduce.hpp"

namespace harmorph {
namespace {

// Quality is that of the caller's cells.
Assessment assess_pieces(OrientedMesh const& cells, Points points, Points displacement,
                         Executor const& executor) noexcept {
    Assessment assessment;
    assessment.limit = admissible_step(cells, points, displacement, executor);
    assessment.quality =
        reduce_cells<Quality>(cells.mesh.n_given, executor, [&](Index i, Quality& quality) {
            auto const moved = [&](Index piece) {
                CellShape shape = shape_of(cells, piece, points);
                CellShape const change = shape_of(cells, piece, displacement);
                for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + change.at[k];
                return shape;
            };
            quality.add(i, {cells.mesh, i, moved}, measure_cell(cells, i, points).area);
        });
    return assessment;
}

}  // namespace

Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor) noexcept {
    if (cells.mesh.is_of_pieces()) return assess_pieces(cells, points, displacement, executor);
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
