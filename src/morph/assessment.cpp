#include "harmorph/morph/assessment.hpp"

#include "harmorph/base/parallel_reduce.hpp"

namespace harmorph {

Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor) noexcept {
    CellKernels const& kernels = cell_kernels(executor.kernel, cells.mesh.n_cells);
    CellPlaces const places{points, displacement, {}};
    return reduce_ranges<Assessment>(cells.mesh.n_cells, executor, [&](Index begin, Index end, Assessment& result) {
        Assessment assessment;
        for_each_batch(cells, begin, end, [&](CellBatches const& batches) {
            Real const step = assessment.limit.step;
            BatchQuality in_triangles, in_quads;
            std::uint64_t const triangles = kernels.triangles(batches.triangles, places, step, &in_triangles);
            std::uint64_t const quads = kernels.quads(batches.quads, places, step, &in_quads);
            assessment.limit.add(cells, places, batches, triangles, quads);
            assessment.quality.add(batches, in_triangles, in_quads);
        });
        result = assessment;
    });
}

}  // namespace harmorph
