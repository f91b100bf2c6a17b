#include "morph/admissible_step.hpp"

#include "base/executor.hpp"

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

namespace {

// Twice the area between two sides is a + slope s + curvature s^2 at the step s.
struct AreaInTime {
    Real slope, curvature, step;  // the step at which the area becomes 0

    AreaInTime(CellShape const& now, CellShape const& change, Index k) noexcept {
        Index const n = now.n, before = k == 0 ? n - 1 : k - 1, behind = k + 1 == n ? 0 : k + 1;
        Vec2 const in = now.at[k] - now.at[before], in_moves = change.at[k] - change.at[before];
        Vec2 const out = now.at[behind] - now.at[k], out_moves = change.at[behind] - change.at[k];
        slope = cross(in, out_moves) + cross(in_moves, out);
        curvature = cross(in_moves, out_moves);
        step = smallest_positive_root(curvature, slope, cross(in, out));
    }
};

// Returns the corner k of cell or guard i with its step; the step is infinite if the area does not
// become 0.
StepCorner step_corner_at(OrientedMesh const& cells, Index i, Index k, Points points,
                          Points displacement) noexcept {
    Cell const cell = cells.cell(i);
    Index const n = cell.n, before = k == 0 ? n - 1 : k - 1, behind = k + 1 == n ? 0 : k + 1;
    CellShape const now = shape_of(cells, i, points), change = shape_of(cells, i, displacement);
    Vec2 const in = now.at[k] - now.at[before], in_moves = change.at[k] - change.at[before];
    Vec2 const out = now.at[behind] - now.at[k], out_moves = change.at[behind] - change.at[k];
    AreaInTime const area(now, change, k);
    StepCorner corner;
    corner.cell = i;
    // AdmissibleStep takes this corner of a guard, and the last digits have to be the same.
    corner.step =
        n == 4 ? area.step
               : AreaInTime(now, change, corner_between_shorter_sides(CellCorners(now))).step;
    if (!(corner.step < infinity)) return corner;
    Index const point[3] = {cell.point[before], cell.point[k], cell.point[behind]};
    for (Index j = 0; j < 3; ++j) corner.point[j] = point[j];
    // Twice the area falls at the rate `fall` where it becomes 0.
    Vec2 const in_there = in + corner.step * in_moves, out_there = out + corner.step * out_moves;
    Real const terms = abs(area.slope) + abs(2 * corner.step * area.curvature),
               fall = -(area.slope + 2 * corner.step * area.curvature);
    corner.has_derivative = fall > 1e-7 * terms;
    if (!corner.has_derivative) return corner;
    Vec2 const by_in = product(rotation_of(cells.mesh, i), Vec2{out_there.y, -out_there.x}),
               by_out = {-in_there.y, in_there.x};
    corner.by_position[0] = (-1 / fall) * by_in;
    corner.by_position[1] = (1 / fall) * (by_in - by_out);
    corner.by_position[2] = (1 / fall) * by_out;
    return corner;
}

// Returns the triangle, of those into which a polygon is divided, that has the points of a guard;
// or none.
Index piece_of(OrientedMesh const& cells, Index guard) noexcept {
    if (cells.mesh.guard_kind[guard - cells.mesh.n_cells] != CornerKind::convex) return none;
    Cell const corner = cells.cell(guard);
    auto const has = [](Cell const& piece, Index point) {
        return piece.point[0] == point || piece.point[1] == point || piece.point[2] == point;
    };
    for (Index const i : cells.mesh.pieces_of(cells.mesh.number(guard))) {
        Cell const piece = cells.cell(i);
        if (has(piece, corner.point[0]) && has(piece, corner.point[1]) &&
            has(piece, corner.point[2]))
            return i;
    }
    return none;
}

}  // namespace

void find_step_corners(OrientedMesh const& cells, Points points, Points displacement,
                       AdmissibleStep const& limit, Real max_step, Executor const& executor,
                       void (*visit)(void* user, StepCorner const& found), void* user) noexcept {
    bool is_limit_visited = false;
    auto const examine = [&](Index i) {
        Cell const cell = cells.cell(i);
        bool const is_guard = i >= cells.mesh.n_cells;
        Index first = is_guard ? 1 : 0, end = is_guard ? 2 : 4;
        if (!is_guard && cell.n == 3) {
            first = corner_between_shorter_sides(CellCorners(CellShape(cell, points, false)));
            end = first + 1;
        }
        for (Index k = first; k < end; ++k) {
            StepCorner const found = step_corner_at(cells, i, k, points, displacement);
            if (!(found.step <= max_step)) continue;
            // A guard and its piece have the same step but for rounding.
            if (found.step <= limit.step * (1 + 1e-12)) is_limit_visited = true;
            visit(user, found);
        }
    };
    // The kernels tell which cells may invert before a step, which is a little larger here, so that
    // they do not leave out a corner at the limit.
    Real const largest = max_step * (1 + 1e-6);
    CellKernels const& kernels = cell_kernels(executor.kernel, cells.mesh.n_cells);
    CellPlaces const places{points, displacement, {}};
    for_each_batch(cells, 0, cells.mesh.n_cells, [&](CellBatches const& batches) {
        CellBounds const bounds = {largest};
        std::uint64_t const triangles =
                                kernels.triangles(batches.triangles, places, bounds, nullptr),
                            quads = kernels.quads(batches.quads, places, bounds, nullptr);
        if ((triangles | quads) == 0) return;
        batches.for_each([&](Index number, bool is_triangle, Index i) {
            if (((is_triangle ? triangles : quads) >> i & 1) != 0) examine(number);
        });
    });
    auto const is_close = [&](Index triangle) {
        return step_corner_at(cells, triangle, 1, points, displacement).step <= max_step;
    };
    // A guard is visited if its piece is not.
    for (Index guard = cells.mesh.n_cells; guard < cells.mesh.n_checked(); ++guard) {
        if (!is_close(guard)) continue;
        Index const piece = piece_of(cells, guard);
        if (piece == none || !is_close(piece)) examine(guard);
    }
    // The kernels may leave out the limit itself if rounding alone makes the area 0 there.
    if (!is_limit_visited) examine(limit.cell);
}

namespace {

// The cells of a mesh after a displacement.
struct DisplacedCells {
    OrientedMesh const& cells;
    Points points, displacement;

    CellShape operator()(Index piece) const noexcept {
        CellShape shape = shape_of(cells, piece, points);
        CellShape const change = shape_of(cells, piece, displacement);
        for (Index k = 0; k < 4; ++k) shape.at[k] = shape.at[k] + change.at[k];
        return shape;
    }
    CellMeasure measure(Index cell) const noexcept {
        if (cells.mesh.has_pieces()) return CellMeasure(cells.mesh, cell, *this);
        CellShape const shape = (*this)(cell);
        return CellMeasure(shape.n, CellCorners(shape));
    }
};

}  // namespace

Quality displaced_quality(OrientedMesh const& cells, Points points, Points displacement,
                          Points reference, Executor const& executor, Real* all) noexcept {
    DisplacedCells const displaced{cells, points, displacement};
    Index const n_cells = cells.mesh.n_given_cells();
    return reduce_cells<Quality>(n_cells, executor, [&](Index cell, Quality& quality) {
        quality.add(cell, displaced.measure(cell), measure_cell(cells, cell, reference).area, all);
    });
}

Assessment assess(OrientedMesh const& cells, Points points, Points displacement,
                  Executor const& executor, bool wants_step, Real* all) noexcept {
    CellPlaces const places{points, displacement, {}};
    DisplacedCells const displaced{cells, points, displacement};
    auto const add_cell = [&](Index i, Assessment& assessment) {
        assessment.quality.add(i, displaced.measure(i), measure_cell(cells, i, points).area, all);
    };
    auto const add_batch = [&](CellKernels const& kernels, CellBatches const& batches,
                               Assessment& assessment) {
        Quality& quality = assessment.quality;
        CellBounds const bounds = {wants_step ? assessment.limit.step : 0, 2 * quality.min_area,
                                   quality.min_quality};
        ListQuality in_triangles, in_quads;
        std::uint64_t const triangles =
            kernels.triangles(batches.triangles, places, bounds, &in_triangles);
        std::uint64_t const quads = kernels.quads(batches.quads, places, bounds, &in_quads);
        if (wants_step) assessment.limit.add(cells, places, batches, triangles, quads);
        quality.add(cells, places, batches, in_triangles, in_quads, all);
    };
    Assessment assessment = reduce_batches<Assessment>(cells, cells.mesh.n_given_cells(), executor,
                                                       add_cell, add_batch);
    // The step of polygons is not known yet, as it also depends on guards.
    if (cells.mesh.has_pieces() && wants_step)
        assessment.limit = admissible_step(cells, points, displacement, executor);
    return assessment;
}

}  // namespace harmorph
