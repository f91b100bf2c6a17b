#include "bspline/airfoil_line.hpp"

namespace harmorph {

void AirfoilLine::lay_out(Arena& arena, Index max_points) noexcept {
    arena.take(at, max_points);
    arena.take(share, max_points);
}

bool AirfoilLine::measure() noexcept {
    trailing = 0.5 * (at[0] + at[n - 1]);
    Index farthest = 0;
    share[0] = 0;
    for (Index k = 1; k < n; ++k) {
        share[k] = share[k - 1] + length(at[k] - at[k - 1]);
        if (square(at[k] - trailing) > square(at[farthest] - trailing)) farthest = k;
    }
    leading = at[farthest];
    Real const first_side = share[farthest], second_side = share[n - 1] - first_side;
    if (!(first_side > 0 && second_side > 0)) return false;
    for (Index k = 0; k < n; ++k) {
        share[k] =
            k <= farthest ? share[k] / first_side : 1 + (share[k] - first_side) / second_side;
    }
    return true;
}

bool AirfoilLine::runs_clockwise() const noexcept {
    Real area = 0;
    for (Index k = 1; k < n; ++k) area += cross(at[k - 1] - at[0], at[k] - at[0]);
    return area < 0;
}

Index AirfoilLine::interval_of(Real wanted, Real& position) const noexcept {
    Index low = 0, high = n - 1;
    while (high - low > 1) {
        Index const middle = low + (high - low) / 2;
        (share[middle] <= wanted ? low : high) = middle;
    }
    Real const width = share[high] - share[low];
    position = width > 0 ? clamp((wanted - share[low]) / width, 0.0, 1.0) : 0;
    return low;
}

}  // namespace harmorph
