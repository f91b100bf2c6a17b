#include "safe/targets.hpp"

#include "morph/quality.hpp"
#include "safe/newton_system.hpp"

namespace harmorph {
namespace {

constexpr Real max_share_of_extent = 0.25;
// The ratio of sides matters for cells with less than this ratio of height and length.
constexpr Real thin = 0.5;
// A task has at least this many cells.
constexpr Index min_cells = 4096;

Real extent_along(CellShape const& shape, Vec2 direction) noexcept {
    Real low = 0, high = 0;
    for (Index k = 1; k < shape.n; ++k) {
        Real const along_side = dot(direction, shape.at[k] - shape.at[0]);
        low = min(low, along_side);
        high = max(high, along_side);
    }
    return high - low;
}

}  // namespace

void Targets::find(OrientedMesh const& cells, FaceDistance const& walls, Points before, Points now,
                   Executor const& executor) noexcept {
    reference = before;
    Real const smallest = measure_quality(cells, before, {}, executor).min_quality;
    aim = 1 + 0.4 * (1 - smallest);
    executor.for_ranges(cells.mesh.n_checked(), min_cells, [&](Index begin, Index end) {
        Index group = 0;
        for (Index i = begin; i < end; ++i) {
            CellShape const shape = shape_of(cells, i, before);
            CellCorners const corners(shape);
            Cell& target = cell[i];
            target = {};
            target.is_quad = target.any_ratio = shape.n == 4;
            target.area = corners.cell_area(shape.n);
            target.own = skew_quality(shape.n, corners);
            target.is_part = cells.mesh.is_piece_or_guard(i);
            target.wanted = target.is_part ? part_of_own : max(smallest, part_of_own * target.own);
            if (walls.count > 0) find_stretch(target, shape, walls, now, group);
        }
    });
}

void Targets::find_stretch(Cell& target, CellShape const& shape, FaceDistance const& walls,
                           Points now, Index& group) const noexcept {
    Vec2 middle;
    for (Index k = 0; k < shape.n; ++k)
        middle = middle + 1 / static_cast<Real>(shape.n) * shape.at[k];
    FaceDistance::Foot const foot = walls.foot(middle, group);
    if (foot.face == none) return;
    const Index(&end)[2] = walls.faces[foot.face].point;
    Vec2 const face = reference[end[1]] - reference[end[0]];
    Real const reach = max_share_of_extent * walls.extent, size = length(face);
    Real const distance = length(middle - walls.at(foot, reference));
    if (!(size > 0) || !(distance < reach)) return;
    Vec2 const along = 1 / size * face;
    Real const ratio = extent_along(shape, {-along.y, along.x}) / extent_along(shape, along);
    if (!(ratio < 1)) return;
    if (ratio < thin) target.any_ratio = false;
    target.along = along;
    target.more =
        (1 - ratio) * (1 - distance / reach) * (length(now[end[1]] - now[end[0]]) / size - 1);
}

Real Targets::quality(Index number, CellShape const& now) const noexcept {
    CellCorners const corners(now);
    Cell const& target = cell[number];
    Real const found = skew_quality(now.n, corners),
               skew = target.is_part ? min(1.0, found / target.own) : found;
    Real const area = corners.cell_area(now.n), before = target.area;
    return skew > 0 ? skew * sqrt(min(area, before) / max(area, before)) : 0;
}

}  // namespace harmorph
