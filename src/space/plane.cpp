#include "space/plane.hpp"

namespace harmorph {
namespace {

// Fewer points are not given to a thread, because starting a thread takes longer.
constexpr Index min_plane_points = 4096;

Real moved_by_step(Real old, Real step) noexcept { return step == 0 ? old : old + step; }

}  // namespace

void Plane::lay_out(Arena& arena, SpaceMesh const& mesh) noexcept {
    Index const max_points = mesh.max_plane_points();
    arena.take(follows, mesh.n_points);
    arena.take(space_point, max_points);
    arena.take(follower_start, Size{1} + static_cast<Size>(max_points));
    arena.take(follower, mesh.n_points);
    arena.take(x, max_points);
    arena.take(y, max_points);
    arena.take(work_x, max_points);
    arena.take(work_y, max_points);
    arena.take(cell_start, Size{1} + static_cast<Size>(mesh.n_faces));
    arena.take(cell_points, mesh.n_corners());
    arena.take(side_points, 2 * Size(mesh.n_sides));
    arena.take(side_markers, mesh.n_sides);
    arena.take(turn, mesh.kind == SpaceKind::planes ? 0 : mesh.n_points);
}

Mesh Plane::mesh() const noexcept {
    Mesh out;
    out.index_base = index_base;
    out.n_points = n_points;
    out.points = {x.data(), y.data(), 1};
    if (has_polygons) out.layout = CellLayout::polygons;
    out.n_cells = n_faces;
    out.cell_start = cell_start.data();
    out.cell_points = cell_points.data();
    out.n_faces = n_sides;
    out.face_points = side_points.data();
    out.face_markers = side_markers.data();
    return out;
}

void Plane::spread(Points displacement, SpacePoints from, MutableSpacePoints to,
                   Executor const& executor) const noexcept {
    executor.for_ranges(n_space_points, min_plane_points, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            Vec3 const step = frame.moved(displacement[follows[k] - index_base], turn_of(k));
            Vec3 const old = from.given() ? from[k] : Vec3{};
            to.set(k, {moved_by_step(old.x, step.x), moved_by_step(old.y, step.y),
                       moved_by_step(old.z, step.z)});
        }
    });
}

void Plane::gather(SpacePoints by_space_points, MutablePoints by_points,
                   Executor const& executor) const noexcept {
    executor.for_ranges(n_points, min_plane_points, [&](Index begin, Index end) {
        for (Index p = begin; p < end; ++p) {
            Vec2 sum;
            for (Index at = follower_start[p]; at < follower_start[p + 1]; ++at) {
                Index const k = follower[at];
                sum = sum + frame.projected(by_space_points[k], turn_of(k));
            }
            by_points.set(p, sum);
        }
    });
}

}  // namespace harmorph
