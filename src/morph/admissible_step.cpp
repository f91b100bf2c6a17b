#include "harmorph/morph/admissible_step.hpp"

#include "harmorph/base/parallel_reduce.hpp"

namespace harmorph {

// The root is taken without cancellation.
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

AdmissibleStep admissible_step(Mesh const& mesh, Points points, Points displacement, Span<const std::uint8_t> reversed,
                               Executor const& executor) noexcept {
    return reduce_ranges<AdmissibleStep>(mesh.n_cells, executor, [&](Index begin, Index end, AdmissibleStep& result) {
        AdmissibleStep limit;
        mesh.for_each_cell(begin, end, [&](Index i, Cell cell) {
            if (reversed[i] != 0) cell.reverse();
            CellShape const now(cell, points, false);
            limit.add(i, now, CellShape(cell, displacement, false), CellCorners(now));
        });
        result = limit;
    });
}

Index limiting_point(Mesh const& mesh, AdmissibleStep const& limit, Span<const std::uint8_t> reversed) noexcept {
    if (limit.cell == none) return none;
    Cell const cell = mesh.cell(limit.cell);
    return cell.point[reversed[limit.cell] != 0 ? cell.n - 1 - limit.corner : limit.corner];
}

}  // namespace harmorph
