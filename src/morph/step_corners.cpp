#include "morph/step_corners.hpp"

namespace harmorph {
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
    Vec2 const by_in = product(turn_of(cells.mesh, i), Vec2{out_there.y, -out_there.x}),
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

}  // namespace harmorph
