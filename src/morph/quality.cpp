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

Quality measure_quality(OrientedMesh const& cells, Points points, Points reference,
                        Executor const& executor) noexcept {
    return reduce_ranges<Quality>(cells.mesh.n_cells, executor, [&](Index begin, Index end, Quality& result) {
        Quality quality;
        cells.mesh.for_each_cell(begin, end, [&](Index i, Cell const& cell) {
            CellCorners const corners(CellShape(cell, points, cells.reversed[i] != 0));
            quality.add(i, cell.n, corners, reference.given() ? cell_area(cell, reference) : 0);
        });
        result = quality;
    });
}

}  // namespace harmorph
