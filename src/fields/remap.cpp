#include "fields/remap.hpp"

#include "base/parallel_reduce.hpp"
#include "base/sort.hpp"

namespace harmorph {
namespace {

constexpr Index corners = 4;

Box box_of(Cell const& cell, Points at) noexcept {
    Box box;
    for (Index k = 0; k < cell.n; ++k) box.include(at[cell.point[k]]);
    return box;
}

}  // namespace

void Remap::lay_out(Arena& arena, Mesh const& from, Mesh const& to, Index n_fields,
                    RemapOrder order) noexcept {
    tree_.lay_out(arena, from.n_cells);
    arena.take(start_, Offset{to.n_points} + 1);
    arena.take(corner_, corners * Offset{to.n_cells});
    bool const is_linear = order == RemapOrder::linear;
    arena.take(volume_, is_linear ? Offset{from.n_points} : 0);
    arena.take(gradient_, is_linear ? Offset{n_fields} * from.n_points : 0);
}

void Remap::build_tree(OrientedMesh const& from, Points at) noexcept {
    tree_.build([&](Index cell) { return box_of(from.cell(cell), at); });
}

void Remap::list_corners(OrientedMesh const& to) noexcept {
    fill(start_, Index{0});
    auto const for_each_corner = [&](auto const& visit) {
        for (Index i = 0; i < to.mesh.n_cells; ++i) {
            Cell const cell = to.cell(i);
            for (Index k = 0; k < cell.n; ++k) visit(cell.point[k], corners * i + k);
        }
    };
    for_each_corner([&](Index point, Index) { ++start_[point]; });
    counts_to_starts(start_);
    for_each_corner([&](Index point, Index code) { corner_[start_[point]++] = code; });
    rewind_starts(start_);
}

// The differences to the neighbouring volumes are weighted with the inverse squares of the
// distances, so that the neighbours across and along a thin layer count alike. An inner side is
// visited from both of its cells, a side on the boundary once. Inside the mesh all sides of a point
// therefore have equal weights; at a point of the boundary, sides on the boundary have half the
// weight of the others.
void Remap::find_gradients(OrientedMesh const& from, Points at, Fields const& fields) noexcept {
    Index const n_points = volume_.count();
    fill(volume_, Reconstruction{});
    fill(gradient_, Vec2{});
    for (Index i = 0; i < from.mesh.n_cells; ++i) {
        Cell const cell = from.cell(i);
        for (Index k = 0; k < cell.n; ++k) {
            Index const point = cell.point[k];
            PolygonMoments const share(CornerPieces(cell, at, at[point]).piece(k));
            volume_[point].area += share.area;
            volume_[point].centroid = volume_[point].centroid + share.first;
        }
    }
    for (Reconstruction& v : volume_)
        if (v.area > 0) v.centroid = (1 / v.area) * v.centroid;
    for (Index i = 0; i < from.mesh.n_cells; ++i) {
        Cell const cell = from.cell(i);
        for (Index k = 0; k < cell.n; ++k) {
            Index const a = cell.point[k], b = cell.next(k);
            Vec2 const apart = (at[b] - at[a]) + (volume_[b].centroid - volume_[a].centroid);
            Vec2 const weighted = (1 / square(apart)) * apart;
            volume_[a].add_neighbour(weighted, apart);
            volume_[b].add_neighbour(weighted, apart);
            for (Index field = 0; field < fields.count; ++field) {
                Offset const first = Offset{field} * n_points;
                Vec2 const change = (fields.from[first + b] - fields.from[first + a]) * weighted;
                gradient_[first + a] = gradient_[first + a] + change;
                gradient_[first + b] = gradient_[first + b] + change;
            }
        }
    }
    for (Index field = 0; field < fields.count; ++field) {
        for (Index point = 0; point < n_points; ++point) {
            Reconstruction const& v = volume_[point];
            Vec2& g = gradient_[Offset{field} * n_points + point];
            Real const determinant = v.xx * v.yy - v.xy * v.xy;
            bool const is_regular = determinant > 1e-24 * (v.xx + v.yy) * (v.xx + v.yy);
            Vec2 const solved{v.yy * g.x - v.xy * g.y, v.xx * g.y - v.xy * g.x};
            g = is_regular ? (1 / determinant) * solved : Vec2{};
        }
    }
}

Remap::Report Remap::run(OrientedMesh const& from, Points from_at, OrientedMesh const& to,
                         Points to_at, Fields const& fields, Span<Real> covered,
                         Executor const& executor) noexcept {
    build_tree(from, from_at);
    list_corners(to);
    if (!volume_.empty()) find_gradients(from, from_at, fields);
    Index const n_from = from.mesh.n_points, n_to = to.mesh.n_points;

    // Adds the integrals of all fields over the common part of a piece of `to` and a piece of
    // `from`; places are relative to a point of `to`.
    auto const add_common = [&](ConvexPolygon const& common, Index source, Index target) {
        PolygonMoments const moments(common);
        if (!(moments.area > 0)) return;
        covered[target] += moments.area;
        Vec2 lever;
        if (!volume_.empty()) {
            Vec2 const centroid = (from_at[source] - to_at[target]) + volume_[source].centroid;
            lever = moments.first - moments.area * centroid;
        }
        for (Index field = 0; field < fields.count; ++field) {
            Offset const at = Offset{field} * n_from + source;
            Real integral = moments.area * fields.from[at];
            if (!volume_.empty()) integral += dot(gradient_[at], lever);
            fields.to[Offset{field} * n_to + target] += integral;
        }
    };
    // Returns the area of the volume of a point of `to`, whose integrals it computes.
    auto const remap_volume = [&](Index target) {
        Vec2 const origin = to_at[target];
        Real own_area = 0;
        Box around;
        covered[target] = 0;
        for (Index field = 0; field < fields.count; ++field)
            fields.to[Offset{field} * n_to + target] = 0;
        Span<const Index> const own =
            corner_.from(start_[target], start_[target + 1] - start_[target]);
        for (Index const code : own) {
            ConvexPolygon const piece =
                CornerPieces(to.cell(code / corners), to_at, origin).piece(code % corners);
            own_area += PolygonMoments(piece).area;
            for (Index k = 0; k < piece.n; ++k) around.include(piece.at[k]);
        }
        // The box is enlarged, as its sum with the origin is rounded.
        Real const margin =
            0x1p-50 * (largest_of(origin) + max(largest_of(around.low), largest_of(around.high)));
        Vec2 const by{margin, margin};
        Box const in_plane{around.low + origin - by, around.high + origin + by};
        tree_.for_items_near(in_plane, [&](Index item) {
            if (!box_of(from.cell(item), from_at).meets(in_plane)) return;
            CornerPieces const sources(from.cell(item), from_at, origin);
            for (Index const code : own) {
                ConvexPolygon const piece =
                    CornerPieces(to.cell(code / corners), to_at, origin).piece(code % corners);
                Box box;
                for (Index k = 0; k < piece.n; ++k) box.include(piece.at[k]);
                if (!box.meets(sources.box)) continue;
                for (Index k = 0; k < sources.cell.n; ++k)
                    add_common(sources.common(piece, k), sources.cell.point[k], target);
            }
        });
        for (Index field = 0; field < fields.count && covered[target] > 0; ++field)
            fields.to[Offset{field} * n_to + target] /= covered[target];
        return own_area;
    };
    return reduce_ranges<Report>(n_to, executor, [&](Index begin, Index end, Report& report) {
        for (Index target = begin; target < end; ++target) {
            Real const area = remap_volume(target);
            report.area += covered[target];
            if (!(area > 0)) continue;
            report.uncovered += covered[target] > 0 ? 0 : 1;
            report.partial +=
                covered[target] > 0 && covered[target] < (1 - missing_share) * area ? 1 : 0;
        }
    });
}

}  // namespace harmorph
