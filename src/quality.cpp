#include "harmorph/quality.hpp"

namespace harmorph {

Real skew_quality(Cell const& cell, Points points, bool reversed) noexcept {
    Real const sign = reversed ? -1 : 1;
    auto const side = [&](Index from, Index to) { return points[to] - points[from]; };
    if (cell.n == 3) {
        Vec2 const a = side(cell.point[0], cell.point[1]), b = side(cell.point[0], cell.point[2]);
        Real const twice_area = sign * cross(a, b);
        return twice_area > 0 ? 1.7320508075688772 * twice_area / (square(a) + square(b) - dot(a, b)) : 0;
    }
    Real sum = 0;
    for (Index corner = 0; corner < 4; ++corner) {
        Vec2 const a = side(cell.point[corner], cell.next(corner)), b = side(cell.point[corner], cell.previous(corner));
        Real const twice_area = sign * cross(a, b);
        if (!(twice_area > 0)) return 0;
        sum += square_root(square(a)) * square_root(square(b)) / twice_area;
    }
    return 4 / sum;
}

Quality measure_quality(Mesh const& mesh, Points points, Points reference, Span<const std::uint8_t> reversed) noexcept {
    Quality quality;
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        Real const smallest = corner_areas(cell, points, reversed[i] != 0).smallest();
        quality.min_area = smaller(quality.min_area, smallest);
        Real its = 0;
        if (smallest > 0) {
            its = skew_quality(cell, points, reversed[i] != 0);
            if (reference.given()) {
                Real const ratio = absolute(cell_area(cell, points) / cell_area(cell, reference));
                its *= square_root(smaller(ratio, 1 / ratio));
            }
        } else {
            if (quality.inverted++ == 0) quality.first_inverted = i;
        }
        quality.mean_quality += its;
        if (its < quality.min_quality) {
            quality.min_quality = its;
            quality.min_quality_cell = i;
        }
    }
    quality.mean_quality /= static_cast<Real>(mesh.n_cells);
    return quality;
}

}  // namespace harmorph
