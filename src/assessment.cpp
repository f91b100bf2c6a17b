#include "harmorph/assessment.hpp"

#include "harmorph/cell_ranges.hpp"

namespace harmorph {

Assessment assess(Mesh const& mesh, Points points, Points displacement, Span<const std::uint8_t> reversed,
                  Executor const& executor) noexcept {
    return reduce_cells<Assessment>(mesh.n_cells, executor, [&](Index i, Assessment& assessment) {
        Cell const cell = mesh.cell(i);
        CellShape const now(cell, points, reversed[i] != 0), change(cell, displacement, reversed[i] != 0);
        CellCorners const corners(now);
        assessment.limit.add(i, now, change, corners);
        CellShape then = now;
        for (Index k = 0; k < 4; ++k) then.at[k] = now.at[k] + change.at[k];
        assessment.quality.add(i, cell.n, CellCorners(then), corners.cell_area(cell.n));
    });
}

}  // namespace harmorph
