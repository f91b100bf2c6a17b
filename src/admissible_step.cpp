#include "harmorph/admissible_step.hpp"

#include "harmorph/cell_ranges.hpp"

namespace harmorph {
namespace {

// Smallest s > 0 with c + b s + a s^2 = 0, where c > 0; infinite if there is none. The root is taken without cancellation.
Real smallest_positive_root(Real a, Real b, Real c) noexcept {
    if (!is_finite(a + b)) return 0;  // a displacement that is not finite leaves nothing
    if (a >= 0 && b >= 0) return infinity;
    if (a == 0) return -c / b;
    Real const discriminant = b * b - 4 * a * c;
    if (discriminant < -4 * epsilon * b * b) return infinity;
    Real const root = square_root(larger(discriminant, 0.0));  // but for rounding, an area that touches 0 has a root there
    if (b <= 0) return 2 * c / (root - b);   // a > 0: the smaller of two positive roots; a < 0: the only one
    return a < 0 ? -(b + root) / (2 * a) : infinity;
}

}  // namespace

void AdmissibleStep::add(Index number, CellShape const& now, CellShape const& change, CellCorners const& corners) noexcept {
    CellCorners const moving(change);
    Index const n_areas = now.n == 3 ? 1 : 4;
    for (Index k = 0; k < n_areas; ++k) {
        Index const before = now.n == 3 ? 0 : (k + 3) & 3, after = now.n == 3 ? 1 : k;  // the sides of this area
        Real const slope = cross(corners.side[before], moving.side[after]) + cross(moving.side[before], corners.side[after]);
        Real const area = corners.twice_area[k];
        // Most corners cannot become 0 before the limit so far: area + slope s - |curvature| s^2 > 0 there.
        Real const curvature = moving.twice_area[k];
        if (area > 0 && step < infinity && area + step * (smaller(slope, 0.0) + step * smaller(curvature, 0.0)) > 0) continue;
        Real const its = area > 0 ? smallest_positive_root(curvature, slope, area) : 0;
        if (its < step) *this = {its, number, k};
    }
}

AdmissibleStep admissible_step(Mesh const& mesh, Points points, Points displacement, Span<const std::uint8_t> reversed,
                               Executor const& executor) noexcept {
    return reduce_cells<AdmissibleStep>(mesh.n_cells, executor, [&](Index i, AdmissibleStep& limit) {
        Cell const cell = mesh.cell(i);
        CellShape const now(cell, points, reversed[i] != 0);
        limit.add(i, now, CellShape(cell, displacement, reversed[i] != 0), CellCorners(now));
    });
}

Index limiting_point(Mesh const& mesh, AdmissibleStep const& limit, Span<const std::uint8_t> reversed) noexcept {
    if (limit.cell == none) return none;
    Cell const cell = mesh.cell(limit.cell);
    return cell.point[reversed[limit.cell] != 0 ? cell.n - 1 - limit.corner : limit.corner];
}

}  // namespace harmorph
