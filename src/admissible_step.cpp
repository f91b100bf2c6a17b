#include "harmorph/admissible_step.hpp"

namespace harmorph {
namespace {

// Smallest s > 0 with c + b s + a s^2 = 0, where c > 0; infinite if there is none. The root is taken without cancellation.
Real smallest_positive_root(Real a, Real b, Real c) noexcept {
    if (a >= 0 && b >= 0) return infinity;
    if (a == 0) return -c / b;
    Real const discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return infinity;
    Real const root = square_root(discriminant);
    if (b <= 0) return 2 * c / (root - b);   // a > 0: the smaller of two positive roots; a < 0: the only one
    return a < 0 ? -(b + root) / (2 * a) : infinity;
}

struct Corner {
    Vec2 a, b;  // its two sides, so that cross(a, b) is twice its area
};

}  // namespace

AdmissibleStep admissible_step(Mesh const& mesh, Points points, Points displacement,
                               Span<const std::uint8_t> reversed) noexcept {
    AdmissibleStep limit;
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        Real const sign = reversed[i] != 0 ? -1 : 1;
        for (Index k = 0; k < (cell.n == 3 ? 1 : 4); ++k) {
            auto const corner_of = [&](Points const& at) {
                Vec2 const apex = at[cell.point[k]];
                return Corner{at[cell.next(k)] - apex, at[cell.previous(k)] - apex};
            };
            Corner const now = corner_of(points), change = corner_of(displacement);
            Real const area = sign * cross(now.a, now.b);
            Real const slope = sign * (cross(now.a, change.b) + cross(change.a, now.b));
            Real const step = area > 0 ? smallest_positive_root(sign * cross(change.a, change.b), slope, area) : 0;
            if (step < limit.step) limit = {step, i, cell.point[k]};
        }
    }
    return limit;
}

}  // namespace harmorph
