#include "morph/assessment.hpp"

#include "base/parallel_reduce.hpp"

namespace harmorph {

namespace {

// The cells of a mesh after a displacement.
struct DisplacedCells {
    OrientedMesh const& cells;
    Points points, displacement;

    CellShape operator()(Index piece) const noexcept {
        CellShape shape = shape_of(cells, piece, points);
        CellShape const change = shape_of(cells, piece, displacement);
        for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + change.at[k];
        return shape;
    }
    CellMeasure measure(Index cell) const noexcept {
        if (cells.mesh.has_pieces()) return CellMeasure(cells.mesh, cell, *this);
        CellShape const shape = (*this)(cell);
        return CellMeasure(shape.n, CellCorners(shape));
    }
};

}  // namespace

Quality displaced_quality(OrientedMesh const& cells, Points points, Points displacement,
                          Points reference, Executor const& executor) noexcept {
    DisplacedCells const displaced{cells, points, displacement};
    Index const n_cells = cells.mesh.n_given_cells();
    return reduce_cells<Quality>(n_cells, executor, [&](Index cell, Quality& quality) {
        quality.add(cell, displaced.measure(cell), measure_cell(cells, cell, reference).area);
    });
}

Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor, bool wants_step) noexcept {
    CellPlaces const places{points, displacement, {}};
    DisplacedCells const displaced{cells, points, displacement};
    auto const add_cell = [&](Index i, Assessment& assessment) {
        assessment.quality.add(i, displaced.measure(i), measure_cell(cells, i, points).area);
    };
    auto const add_batch = [&](CellKernels const& kernels, CellBatches const& batches,
                               Assessment& assessment) {
        Quality& quality = assessment.quality;
        CellBounds const bounds = {wants_step ? assessment.limit.step : 0, 2 * quality.min_area,
                                   quality.min_quality};
        ListQuality in_triangles, in_quads;
        std::uint64_t const triangles =
            kernels.triangles(batches.triangles, places, bounds, &in_triangles);
        std::uint64_t const quads = kernels.quads(batches.quads, places, bounds, &in_quads);
        if (wants_step) assessment.limit.add(cells, places, batches, triangles, quads);
        quality.add(cells, places, batches, in_triangles, in_quads);
    };
    Assessment assessment = reduce_batches<Assessment>(cells, cells.mesh.n_given_cells(), executor,
                                                       add_cell, add_batch);
    // The step of polygons is not known yet, as it also depends on guards.
    if (cells.mesh.has_pieces() && wants_step)
        assessment.limit = admissible_step(cells, points, displacement, executor);
    return assessment;
}

}  // namespace harmorph
