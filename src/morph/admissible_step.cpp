#include "morph/admissible_step.hpp"

#include "base/parallel_reduce.hpp"

namespace harmorph {

// Solves for the root without cancellation.
Real smallest_positive_root(Real a, Real b, Real c) noexcept {
    Real const size = max(max(abs(a), abs(b)), c);
    // A displacement or an area that is not finite admits no step.
    if (!is_finite(a) || !is_finite(b) || !is_finite(c)) return 0;
    if (a >= 0 && b >= 0) return infinity;
    // The squares of such areas would overflow or underflow.
    if (!(size > 0x1p-200 && size < 0x1p200)) {
        Real const scale = power_of_two_at(size);
        a /= scale;
        b /= scale;
        c /= scale;
    }
    if (a == 0) return -c / b;
    Real const discriminant = b * b - 4 * a * c;
    if (discriminant < -4 * epsilon * b * b) return infinity;
    // An area that touches 0 has a root there, except for rounding.
    Real const root = sqrt(max(discriminant, 0.0));
    // This is the smaller of two positive roots if a > 0, and the only one if a < 0.
    if (b <= 0) return 2 * c / (root - b);
    return a < 0 ? -(b + root) / (2 * a) : infinity;
}

void AdmissibleStep::add(OrientedMesh const& cells, CellPlaces const& places,
                         CellBatches const& batches, std::uint64_t triangles,
                         std::uint64_t quads) noexcept {
    if ((triangles | quads) == 0) return;
    batches.for_each([&](Index number, bool is_triangle, Index i) {
        if (((is_triangle ? triangles : quads) >> i & 1) == 0) return;
        Cell const corners = cells.cell(number);
        add(number, corners.n, CellCorners({corners, places.at, false}),
            CellCorners({corners, places.change, false}));
    });
}

AdmissibleStep admissible_step(OrientedMesh const& cells, Points points, Points displacement,
                               Executor const& executor) noexcept {
    CellKernels const& kernels = cell_kernels(executor.kernel, cells.mesh.n_cells);
    CellPlaces const places{points, displacement, {}};
    AdmissibleStep overall = reduce_ranges<AdmissibleStep>(
        cells.mesh.n_cells, executor, [&](Index begin, Index end, AdmissibleStep& result) {
            AdmissibleStep limit;
            for_each_batch(cells, begin, end, [&](CellBatches const& batches) {
                CellBounds const bounds = {limit.step};
                std::uint64_t const triangles =
                    kernels.triangles(batches.triangles, places, bounds, nullptr);
                limit.add(cells, places, batches, triangles,
                          kernels.quads(batches.quads, places, bounds, nullptr));
            });
            result = limit;
        });
    overall.merge(reduce_cells<AdmissibleStep>(
        cells.mesh.n_guards, executor, [&](Index guard, AdmissibleStep& result) {
            Index const i = cells.mesh.n_cells + guard;
            CellShape const now = shape_of(cells, i, points);
            result.add(i, now.n, CellCorners(now), CellCorners(shape_of(cells, i, displacement)));
        }));
    return overall;
}

Index limiting_point(OrientedMesh const& cells, AdmissibleStep const& limit) noexcept {
    if (limit.cell == none) return none;
    bool const is_guard = limit.cell >= cells.mesh.n_cells;
    return cells.cell(limit.cell).point[is_guard ? 1 : limit.corner];
}

}  // namespace harmorph
