#include "fields/walls.hpp"

#include "base/vec2.hpp"

namespace harmorph {

Index Walls::count_faces(Boundary const& boundary, Span<const Index> markers) noexcept {
    Index n = 0;
    for (Index const marker : boundary.marker.first(boundary.count)) n += contains(markers, marker);
    return n;
}

void Walls::lay_out(Arena& arena, Analysis const& analysis, Index faces) noexcept {
    Size const n = static_cast<Size>(faces);
    tree.lay_out(arena, n);
    layer.lay_out(arena, analysis.problem().mesh, n);
    arena.take(segments, n);
    arena.take(face_point, 2 * n);
    arena.take(face_marker, n);
    arena.take(wall_point, WallPoints::max_count(analysis.problem().mesh.n_points, n));
    arena.take(above, WallPoints::max_count(analysis.problem().mesh.n_points, n));
}

void Walls::find(Analysis const& analysis, Span<const Index> markers, Points at) noexcept {
    Boundary const& boundary = analysis.boundary();
    Mesh const& mesh = analysis.problem().mesh;
    n_points = mesh.n_points;
    index_base = mesh.index_base;
    tree.kernel = resolved(Kernel::automatic, analysis.problem().executor.kernel);
    Index n = 0;
    tree.choose(boundary, [&](Index face) {
        bool const chosen = contains(markers, boundary.marker[face]);
        if (chosen) face_marker[n++] = boundary.marker[face];
        return chosen;
    });
    for (Index face = 0; face < n; ++face) {
        for (Index end = 0; end < 2; ++end)
            face_point[2 * face + end] = tree.faces[face].point[end] + index_base;
    }
    layer.find(mesh, at, analysis.topology().representative, tree.chosen());
    for (Index slot = 0; slot < layer.wall.count; ++slot) {
        wall_point[slot] = layer.wall.point[slot] + index_base;
        above[slot] = layer.above[slot] == none ? none : layer.above[slot] + index_base;
    }
    move_to(at);
}

void Walls::move_to(Points at) noexcept {
    tree.build(at);
    for (Index face = 0; face < n_faces(); ++face) {
        FaceDistance::Face const& ends = tree.faces[face];
        Vec2 const begin = at[ends.point[0]], end = at[ends.point[1]];
        Real const size = length(end - begin), inverse = size > 0 ? 1 / size : 0;
        segments[face] = {begin, end, inverse, inverse * inverse};
    }
}

WallFoot Walls::place_on(Index face, Vec2 from) const noexcept {
    Segment const& segment = segments[face];
    Vec2 const along = segment.end - segment.begin, off_begin = from - segment.begin,
               off_end = from - segment.end;
    WallFoot out;
    out.face = face;
    // Both ends are tested separately, so that a foot at an end is exactly this end.
    Real const covered = dot(off_begin, along);
    if (!(covered > 0)) {
        out.distance = length(off_begin);
    } else if (!(dot(off_end, along) < 0)) {
        out.t = 1;
        out.distance = length(off_end);
    } else {
        out.t = min(covered * segment.inverse_square, 1.0);
        out.distance = abs(cross(along, off_begin)) * segment.inverse_length;
    }
    return out;
}

WallFoot Walls::foot_on(Index face, Vec2 from) const noexcept {
    Segment const& segment = segments[face];
    WallFoot out = place_on(face, from);
    Vec2 const along = segment.end - segment.begin, off_begin = from - segment.begin,
               off_end = from - segment.end;
    bool const at_begin = !(dot(off_begin, along) > 0), at_end = !(dot(off_end, along) < 0);
    if ((at_begin || at_end) && out.distance > 0) {
        out.normal = (1 / out.distance) * (at_begin ? off_begin : off_end);
    } else {
        Vec2 const left = left_of(direction(along));
        out.normal = out.distance > 0 && cross(along, off_begin) < 0 ? -1.0 * left : left;
    }
    return out;
}

void Walls::heights(Points at, Span<Real> height) const noexcept {
    for (Index slot = 0; slot < layer.wall.count; ++slot) {
        height[slot] = layer.above[slot] == none ? 0 : layer.height(slot, at);
    }
}

}  // namespace harmorph
