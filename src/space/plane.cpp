#include "space/plane.hpp"

#include "base/sort.hpp"

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
    arena.take(rotation, mesh.kind == SpaceKind::planes ? 0 : mesh.n_points);
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
            Vec3 const step = frame.moved(displacement[follows[k] - index_base], rotation_of(k));
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
                sum = sum + frame.projected(by_space_points[k], rotation_of(k));
            }
            by_points.set(p, sum);
        }
    });
}

namespace {

// Points of the plane are at one place if their distance is at most this part of the tolerance.
// Interfaces of mesh generators have points that differ by rounding on the two sides.
constexpr Real part_of_tolerance = 1e-4;
constexpr Real tiny_square = 1e-300;

Vec2 place_of(Plane const& plane, Index p) noexcept { return {plane.x[p], plane.y[p]}; }

}  // namespace

void PlaneSearch::lay_out(Arena& arena, SpaceMesh const& mesh) noexcept {
    Index const max_points = mesh.max_plane_points();
    arena.take(known, mesh.n_points);
    arena.take(reach, max_points);
    arena.take(first_at_place, max_points);
    arena.take(next_at_place, max_points);
    arena.take(ambiguous, mesh.n_points);
    tree.lay_out(arena, max_points);
}

Status PlaneSearch::run(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept {
    plane.index_base = mesh.index_base;
    plane.n_space_points = mesh.n_points;
    plane.n_faces = mesh.n_faces;
    fill(known, std::uint8_t{0});
    for (Index i = 0; i < mesh.n_faces; ++i) {
        SpaceFace const face = mesh.face(i);
        for (Index k = 0; k < face.n; ++k) known[face.point(k)] = 1;
    }
    HARMORPH_TRY(find_frame(mesh, known, plane.frame, fault));
    if (plane.frame.kind != SpaceKind::wedge) plane.rotation = {};
    number_points(mesh, plane);
    copy_cells(mesh, plane);
    find_reach(plane);
    tree.set_count(plane.n_points);
    tree.build([&](Index p) {
        Box box;
        box.include(place_of(plane, p));
        return box;
    });
    find_places(plane);
    HARMORPH_TRY(follow(mesh, plane, fault));
    HARMORPH_TRY(list_followers(plane, fault));
    return copy_sides(mesh, plane, fault);
}

// The points of the plane have the order of the points of space.
void PlaneSearch::number_points(SpaceMesh const& mesh, Plane& plane) noexcept {
    plane.n_points = 0;
    for (Index k = 0; k < mesh.n_points; ++k) {
        if (known[k] == 0) continue;
        Index const p = plane.n_points++;
        Vec2 const place = plane.frame.in_plane(mesh.points[k]);
        plane.x[p] = place.x;
        plane.y[p] = place.y;
        plane.space_point[p] = k + plane.index_base;
        plane.follows[k] = p + plane.index_base;
        if (!plane.rotation.empty()) plane.rotation[k] = {1, 0};
    }
}

void PlaneSearch::copy_cells(SpaceMesh const& mesh, Plane& plane) noexcept {
    Index n = 0;
    plane.has_polygons = false;
    for (Index i = 0; i < mesh.n_faces; ++i) {
        SpaceFace const face = mesh.face(i);
        plane.has_polygons = plane.has_polygons || face.n > 4;
        plane.cell_start[i] = n + plane.index_base;
        for (Index k = 0; k < face.n; ++k) plane.cell_points[n++] = plane.follows[face.point(k)];
    }
    plane.cell_start[mesh.n_faces] = n + plane.index_base;
}

// Finds how far a follower may be from the point of the plane: as far as the tolerance, but not
// farther than a quarter of the shortest edge at the point of the plane.
void PlaneSearch::find_reach(Plane const& plane) noexcept {
    fill(reach, plane.frame.tolerance * plane.frame.tolerance);
    for (Index i = 0; i < plane.n_faces; ++i) {
        Index const begin = plane.cell_start[i] - plane.index_base,
                    end = plane.cell_start[i + 1] - plane.index_base;
        for (Index k = begin; k < end; ++k) {
            Index const a = plane.cell_points[k] - plane.index_base;
            Index const b = plane.cell_points[k + 1 == end ? begin : k + 1] - plane.index_base;
            Real const bound = square(place_of(plane, b) - place_of(plane, a)) / 16;
            if (bound == 0) continue;
            reach[a] = min(reach[a], bound);
            reach[b] = min(reach[b], bound);
        }
    }
}

// Builds lists of points at one place.
void PlaneSearch::find_places(Plane const& plane) noexcept {
    Real const apart = part_of_tolerance * plane.frame.tolerance;
    for (Index p = 0; p < plane.n_points; ++p) {
        Vec2 const here = place_of(plane, p);
        Index first = p;
        Real const bound = min(apart * apart, reach[p]);
        // The search visits points nearer than the given distance, which must not be 0: otherwise
        // points at the same place would not be visited.
        tree.nearest(here, {none, bound > 0 ? 2 * bound : tiny_square}, [&](Index other) {
            if (other < first && square(place_of(plane, other) - here) <= bound) first = other;
            return infinity;  // lets the search visit all other points
        });
        first_at_place[p] = first == p ? p : first_at_place[first];
        next_at_place[p] = none;
    }
    for (Index p = plane.n_points; p-- > 0;) {
        Index const first = first_at_place[p];
        if (first == p) continue;
        next_at_place[p] = next_at_place[first];
        next_at_place[first] = p;
    }
}

Status PlaneSearch::follow(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept {
    Size n_ambiguous = 0;
    for (Index k = 0; k < mesh.n_points; ++k) {
        if (known[k] != 0) continue;
        PlacedPoint const placed = plane.frame.placed(mesh.points[k]);
        auto const squared = [&](Index p) { return square(place_of(plane, p) - placed.place); };
        Nearest const near = tree.nearest(placed.place, {}, squared);
        if (near.item == none || !(near.squared <= reach[near.item])) {
            constexpr const char* text =
                "the projection of point # is ~ away from the nearest point of the faces, so the "
                "mesh is not an extruded or rotated plane mesh";
            return fault.refuse(Status::bad_mesh, text, point_item(k), {}, sqrt(near.squared));
        }
        Real const distance = sqrt(near.squared);
        if (distance > plane.max_distance) {
            plane.max_distance = distance;
            plane.max_distance_point = k;
        }
        Index const first = first_at_place[near.item];
        plane.follows[k] = first + plane.index_base;
        if (!plane.rotation.empty()) plane.rotation[k] = placed.rotation;
        if (next_at_place[first] != none) ambiguous[n_ambiguous++] = {first, k, placed.across};
    }
    if (n_ambiguous > 0) {
        follow_sides(mesh, plane);
        resolve(plane, n_ambiguous);
    }
    return Status::ok;
}

// Layers may number several points at one place in different orders. An edge of a side from one
// layer to the next says which point follows which, and so does the next edge for the layer behind.
void PlaneSearch::follow_sides(SpaceMesh const& mesh, Plane& plane) noexcept {
    for (bool found = true; found;) {
        found = false;
        for (Offset k = 0; k < Offset{4} * mesh.n_sides; ++k) {
            Offset const next = k % 4 == 3 ? k - 3 : k + 1;
            found = follow_edge(mesh.side_points[k] - mesh.index_base,
                                mesh.side_points[next] - mesh.index_base, plane) ||
                    found;
        }
    }
}

// Returns whether the edge of a side has said which point one of its ends follows.
bool PlaneSearch::follow_edge(Index one, Index next, Plane& plane) noexcept {
    if (known[one] == known[next]) return false;
    Index const a = known[one] != 0 ? one : next, b = one + next - a;
    Index const place = first_at_place[plane.follows[a] - plane.index_base];
    bool const is_opposite = place == first_at_place[plane.follows[b] - plane.index_base];
    if (!is_opposite || next_at_place[place] == none) return false;
    plane.follows[b] = plane.follows[a];
    known[b] = 1;
    return true;
}

// If n points of the plane coincide, each layer normally has n points opposite to them. If a layer
// has fewer points, because it joins them, all that no side joins follow the first point of the
// plane.
void PlaneSearch::resolve(Plane& plane, Size n_ambiguous) noexcept {
    Span<Ambiguous> const all = ambiguous.first(n_ambiguous);
    sort(all, [](Ambiguous const& a, Ambiguous const& b) {
        if (a.place != b.place) return a.place < b.place;
        return a.across != b.across ? a.across < b.across : a.point < b.point;
    });
    for (Size begin = 0; begin < n_ambiguous;) {
        Index const place = all[begin].place;
        Size n = 0, end = begin;
        for (Index p = place; p != none; p = next_at_place[p]) ++n;
        while (end < n_ambiguous && all[end].place == place) ++end;
        for (Size layer = begin; (end - begin) % n == 0 && layer < end; layer += n)
            follow_remaining(plane, place, all.from(layer, n));
        begin = end;
    }
}

// The points of a layer that no side joins, in the order of their numbers, follow those points of
// the plane at the place that no other point of the layer follows.
void PlaneSearch::follow_remaining(Plane& plane, Index place, Span<Ambiguous> layer) noexcept {
    auto const order = [&](Ambiguous const& one) {
        return known[one.point] != 0 ? plane.follows[one.point] : one.point;
    };
    sort(layer, [&](Ambiguous const& a, Ambiguous const& b) {
        bool const of_a = known[a.point] != 0, of_b = known[b.point] != 0;
        return of_a != of_b ? of_a : order(a) < order(b);
    });
    Size n_known = 0;
    while (n_known < layer.size() && known[layer[n_known].point] != 0) ++n_known;
    Size taken = 0, remaining = n_known;
    for (Index p = place; p != none && remaining < layer.size(); p = next_at_place[p]) {
        Size const before = taken;
        while (taken < n_known && plane.follows[layer[taken].point] == p + plane.index_base)
            ++taken;
        if (taken == before) plane.follows[layer[remaining++].point] = p + plane.index_base;
    }
}

Status PlaneSearch::list_followers(Plane& plane, Fault& fault) noexcept {
    Span<Index> const start = plane.follower_start.first(plane.n_points + 1);
    fill(start, Index{0});
    for (Index k = 0; k < plane.n_space_points; ++k) ++start[plane.follows[k] - plane.index_base];
    plane.layers = 0;
    for (Index p = 0; p < plane.n_points; ++p) plane.layers = max(plane.layers, start[p]);
    for (Index p = 0; p < plane.n_points; ++p) {
        bool const on_axis =
            plane.frame.kind == SpaceKind::wedge && plane.y[p] <= plane.frame.tolerance;
        if (start[p] > 1 || plane.layers == 1 || on_axis) continue;
        return fault.refuse(Status::bad_mesh,
                            "point # of the faces has no opposite point in another layer",
                            point_item(plane.space_point[p] - plane.index_base));
    }
    counts_to_starts(start);
    for (Index k = 0; k < plane.n_space_points; ++k)
        plane.follower[start[plane.follows[k] - plane.index_base]++] = k;
    rewind_starts(start);
    return Status::ok;
}

Status PlaneSearch::copy_sides(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept {
    plane.n_sides = mesh.n_sides;
    for (Index i = 0; i < mesh.n_sides; ++i) {
        Index ends[4] = {};
        Index n = 0;
        for (Index k = 0; k < 4; ++k) {
            Index const p = plane.follows[mesh.side_points[Offset{4} * i + k] - mesh.index_base];
            bool is_listed = false;
            for (Index earlier = 0; earlier < n; ++earlier)
                is_listed = is_listed || ends[earlier] == p;
            if (!is_listed) ends[n++] = p;
        }
        if (n != 2) {
            return fault.refuse(
                Status::bad_mesh,
                "the points of side # belong to ~ points of the plane, but must belong to 2",
                side_item(i), {}, static_cast<Real>(n));
        }
        plane.side_points[2 * i] = ends[0];
        plane.side_points[2 * i + 1] = ends[1];
        plane.side_markers[i] = mesh.side_markers[i];
    }
    return Status::ok;
}

}  // namespace harmorph
