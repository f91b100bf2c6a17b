#include "harmorph/quality.hpp"

#include "harmorph/cell_ranges.hpp"

namespace harmorph {

Real skew_quality(Index n, CellCorners const& corners) noexcept {
    if (!(corners.smallest() > 0)) return 0;
    const Vec2* const side = corners.side;
    if (n == 3) {
        Real const squares = square(side[0]) + square(side[1]) + square(side[2]);  // = 2 (a.a + b.b - a.b)
        return 2 * 1.7320508075688772 * corners.twice_area[0] / squares;
    }
    Real length[4], sum = 0;
    for (Index k = 0; k < 4; ++k) length[k] = square_root(square(side[k]));
    for (Index k = 0; k < 4; ++k) sum += length[(k + 3) & 3] * length[k] / corners.twice_area[k];
    return 4 / sum;
}

void Quality::add(Index cell, Index n, CellCorners const& corners, Real reference_area) noexcept {
    ++cells;
    Real const twice_smallest = corners.smallest();
    min_area = smaller(min_area, 0.5 * twice_smallest);
    Real its = 0;
    if (twice_smallest > 0) {
        its = skew_quality(n, corners);
        if (reference_area != 0) {
            Real const ratio = absolute(corners.cell_area(n) / reference_area);
            its *= square_root(smaller(ratio, 1 / ratio));
        }
    } else {
        if (inverted++ == 0) first_inverted = cell;
    }
    quality_sum += its;
    if (its < min_quality) {
        min_quality = its;
        min_quality_cell = cell;
    }
}

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

Quality measure_quality(Mesh const& mesh, Points points, Points reference, Span<const std::uint8_t> reversed,
                        Executor const& executor) noexcept {
    return reduce_cells<Quality>(mesh.n_cells, executor, [&](Index i, Quality& quality) {
        Cell const cell = mesh.cell(i);
        CellCorners const corners(CellShape(cell, points, reversed[i] != 0));
        quality.add(i, cell.n, corners, reference.given() ? cell_area(cell, reference) : 0);
    });
}

}  // namespace harmorph
