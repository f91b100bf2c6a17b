#include "harmorph/morph/assessment.hpp"

#include "harmorph/base/parallel_reduce.hpp"

namespace harmorph {

Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor) noexcept {
    return reduce_ranges<Assessment>(cells.mesh.n_cells, executor, [&](Index begin, Index end, Assessment& result) {
        Assessment assessment;
        cells.mesh.for_each_cell(begin, end, [&](Index i, Cell cell) {
            if (cells.reversed[i] != 0) cell.reverse();
            CellShape const now(cell, points, false), change(cell, displacement, false);
            CellCorners const corners(now);
            assessment.limit.add(i, now, change, corners);
            CellShape then = now;
            for (Index k = 0; k < 4; ++k) then.at[k] = now.at[k] + change.at[k];
            assessment.quality.add(i, cell.n, CellCorners(then), corners.cell_area(cell.n));
        });
        result = assessment;
    });
}

}  // namespace harmorph
