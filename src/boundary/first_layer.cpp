#include "boundary/first_layer.hpp"

#include "base/vec2.hpp"

namespace harmorph {

void WallPoints::lay_out(Arena& arena, Index n_points, Size max_faces) noexcept {
    Size const n = max_count(n_points, max_faces);
    arena.take(point, n);
    arena.take(previous, n);
    arena.take(next, n);
    arena.take(slot, n_points);
}

void WallPoints::find(Index n_points, Span<const FaceDistance::Face> walls) noexcept {
    count = 0;
    fill(slot.first(n_points), none);
    auto const slot_of = [&](Index wall_point) {
        if (slot[wall_point] == none) {
            slot[wall_point] = count;
            point[count] = wall_point;
            previous[count] = next[count] = none;
            ++count;
        }
        return slot[wall_point];
    };
    for (FaceDistance::Face const& face : walls) {
        next[slot_of(face.point[0])] = face.point[1];
        previous[slot_of(face.point[1])] = face.point[0];
    }
}

Vec2 WallPoints::tangent(Index at_slot, Points points) const noexcept {
    Vec2 const here = points[point[at_slot]];
    if (previous[at_slot] == none) return points[next[at_slot]] - here;
    Vec2 const behind = here - points[previous[at_slot]];
    if (next[at_slot] == none) return behind;
    Vec2 const ahead = points[next[at_slot]] - here;
    return length(ahead) * direction(behind) + length(behind) * direction(ahead);
}

Vec2 WallPoints::rotation(Index at_slot, Points before, Points after) const noexcept {
    Vec2 sum{};
    Index const here = point[at_slot], from[] = {previous[at_slot], here},
                to[] = {here, next[at_slot]};
    Real weight[2] = {1, 1};  // the weights of tangent()
    if (from[0] != none && to[1] != none) {
        for (Index face = 0; face < 2; ++face)
            weight[1 - face] = length(before[to[face]] - before[from[face]]);
    }
    for (Index face = 0; face < 2; ++face) {
        if (from[face] == none || to[face] == none) continue;
        Vec2 const old_side = direction(before[to[face]] - before[from[face]]);
        Vec2 const new_side = direction(after[to[face]] - after[from[face]]);
        sum = sum + weight[face] * direction(rotation_between(old_side, new_side));
    }
    Vec2 const rotation = direction(sum);
    return rotation.x == 0 && rotation.y == 0 ? Vec2{1, 0} : rotation;
}

void FirstLayer::lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept {
    wall.lay_out(arena, mesh.n_points, max_faces);
    arena.take(above, WallPoints::max_count(mesh.n_points, max_faces));
}

void FirstLayer::find(Mesh const& mesh, Points points, Span<const Index> representative,
                      Span<const FaceDistance::Face> walls) noexcept {
    wall.find(mesh.n_points, walls);
    fill(above, none);
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        for (Index k = 0; k < cell.n; ++k) {
            Index const here = representative[cell.point[k]], slot = wall.slot[here];
            if (slot == none) continue;
            Vec2 const normal = left_of(wall.tangent(slot, points));
            auto const slope = [&](Index to) {
                return dot(direction(points[to] - points[here]), normal);
            };
            Index const neighbours[] = {cell.next(k), cell.previous(k)};
            for (Index const neighbour : neighbours) {
                Index const to = representative[neighbour];
                // The representative may be on the other side of a periodic pair.
                bool const is_beyond = length(points[to] - points[neighbour]) > 0;
                if (wall.slot[to] != none || is_beyond) continue;
                Real const largest = above[slot] == none ? 0 : slope(above[slot]);
                if (slope(to) > largest) above[slot] = to;
            }
        }
    }
}

LayerChange change_of(FirstLayer const& layer, Index slot, Points before, Points after) noexcept {
    Index const foot = layer.wall.point[slot], top = layer.above[slot];
    Vec2 const rotation = layer.wall.rotation(slot, before, after);
    Vec2 const normal = layer.wall.normal(slot, before);
    Vec2 const old_edge = before[top] - before[foot],
               new_edge = rotated_back(after[top] - after[foot], rotation);
    Real const angle = abs(angle_of(rotation_between(direction(old_edge), direction(new_edge))));
    return {in_degrees(angle), dot(new_edge, normal) / dot(old_edge, normal)};
}

Real FirstLayer::height(Index slot, Points points) const noexcept {
    return dot(points[above[slot]] - points[wall.point[slot]], wall.normal(slot, points));
}

FirstLayerChange compare(FirstLayer const& layer, Points before, Points after) noexcept {
    FirstLayerChange change;
    for (Index slot = 0; slot < layer.wall.count; ++slot) {
        if (layer.above[slot] == none) continue;
        Index const foot = layer.wall.point[slot];
        auto const [angle, ratio] = change_of(layer, slot, before, after);
        ++change.points;
        change.mean_angle += angle;
        change.mean_ratio += ratio;
        if (change.largest_angle_point == none || angle > change.largest_angle) {
            change.largest_angle = angle;
            change.largest_angle_point = foot;
        }
        if (ratio < change.min_ratio) {
            change.min_ratio = ratio;
            change.min_ratio_point = foot;
        }
        if (ratio > change.max_ratio) {
            change.max_ratio = ratio;
            change.max_ratio_point = foot;
        }
    }
    if (change.points == 0) return change;
    change.mean_angle /= static_cast<Real>(change.points);
    change.mean_ratio /= static_cast<Real>(change.points);
    return change;
}

namespace {

constexpr Real max_reach = 0.25;  // as a fraction of the extent of all walls
constexpr Real growth = 0.5;      // the largest growth of the reach, per length along the wall
// The nearest wall changes between two points of one cell if the distance of their feet is larger
// than the distance of the points by this factor.
constexpr Real min_jump = 3;
// Fewer points are not given to a thread, because starting a thread takes longer.
constexpr Index min_points_near_walls = 4096;

Real fade(Real x) noexcept { return x < 1 ? 1 - x * (3 - 2 * sqrt(x)) : 0; }

}  // namespace

void WallHeights::lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept {
    Size const max_count = WallPoints::max_count(mesh.n_points, max_faces);
    wall.lay_out(arena, mesh.n_points, max_faces);
    arena.take(foot, mesh.n_points);
    arena.take(reach, max_count);
    arena.take(rotation, max_count);
}

void WallHeights::find(Mesh const& mesh, Points before, Span<const PointKind> kinds,
                       Span<const Index> representative, FaceDistance const& walls,
                       Executor const& executor) noexcept {
    wall.find(mesh.n_points, walls.chosen());
    executor.for_ranges(mesh.n_points, min_points_near_walls, [&](Index begin, Index end) {
        Index group = 0;
        for (Index k = begin; k < end; ++k) {
            foot[k] =
                kinds[k] == PointKind::inside ? walls.foot(before[k], group) : FaceDistance::Foot{};
        }
    });
    bound_by_curvature(walls, before);
    grade(walls, before);
    bound_by_jumps(mesh, before, representative, walls);
    grade(walls, before);
    for (Index k = 0; k < mesh.n_points; ++k) {
        if (foot[k].face != none && !(height(walls, k, before) < reach_at(walls, foot[k])))
            foot[k] = {};
    }
}

Real WallHeights::height(FaceDistance const& walls, Index point, Points before) const noexcept {
    return length(before[point] - walls.at(foot[point], before));
}

Real WallHeights::reach_at(FaceDistance const& walls, FaceDistance::Foot const& at) const noexcept {
    FaceDistance::Face const& face = walls.faces[at.face];
    return (1 - at.t) * reach[wall.slot[face.point[0]]] + at.t * reach[wall.slot[face.point[1]]];
}

void WallHeights::bound_by_curvature(FaceDistance const& walls, Points before) noexcept {
    for (Index slot = 0; slot < wall.count; ++slot) {
        reach[slot] = 0;
        if (wall.previous[slot] == none || wall.next[slot] == none) continue;
        Vec2 const here = before[wall.point[slot]];
        Vec2 const behind = here - before[wall.previous[slot]],
                   ahead = before[wall.next[slot]] - here;
        Real const turning = length(direction(ahead) - direction(behind)),
                   limit = max_reach * walls.extent;
        Real const mean = 0.5 * (length(ahead) + length(behind));
        reach[slot] = mean < limit * turning ? mean / turning : limit;
    }
}

// Bounds the reach beside boundaries that are not walls, and where two points of one cell have feet
// far from each other, because the nearest wall changes between the points.
void WallHeights::bound_by_jumps(Mesh const& mesh, Points before, Span<const Index> representative,
                                 FaceDistance const& walls) noexcept {
    auto const bound = [&](Index near_point) {
        Real const limit = height(walls, near_point, before);
        for (Index const end : walls.faces[foot[near_point].face].point) {
            reach[wall.slot[end]] = min(reach[wall.slot[end]], limit);
        }
    };
    auto const has_foot = [&](Index near_point) { return foot[near_point].face != none; };
    auto const is_jump = [&](Index a, Index b) {
        if (!has_foot(b)) return wall.slot[b] == none;
        Real const between_feet = length(walls.at(foot[a], before) - walls.at(foot[b], before));
        return between_feet > min_jump * length(before[a] - before[b]);
    };
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        for (Index k = 0; k < cell.n; ++k) {
            Index const here = representative[cell.point[k]];
            if (!has_foot(here) || !(height(walls, here, before) < max_reach * walls.extent))
                continue;
            Index const next = representative[cell.next(k)],
                        previous = representative[cell.previous(k)];
            if (is_jump(here, next) || is_jump(here, previous)) bound(here);
        }
    }
}

// Limits the growth of the reach along the wall. Two passes over the faces in both directions go
// round every loop, wherever it begins.
void WallHeights::grade(FaceDistance const& walls, Points before) noexcept {
    auto const limit = [&](Index face, Index from) {
        Index const a = walls.faces[face].point[from], b = walls.faces[face].point[1 - from];
        Real const bound = reach[wall.slot[a]] + growth * length(before[a] - before[b]);
        reach[wall.slot[b]] = min(reach[wall.slot[b]], bound);
    };
    for (Index pass = 0; pass < 2; ++pass) {
        for (Index face = 0; face < walls.count; ++face) limit(face, 0);
        for (Index face = walls.count; face-- > 0;) limit(face, 1);
    }
}

void WallHeights::restore(FaceDistance const& walls, Points before, MutablePoints points,
                          Span<const Index> representative, Real amount,
                          Executor const& executor) const noexcept {
    Points const after{points.x, points.y, points.stride};
    for (Index slot = 0; slot < wall.count; ++slot)
        rotation[slot] = wall.rotation(slot, before, after);
    executor.for_ranges(foot.count(), min_points_near_walls, [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
            FaceDistance::Foot const& foot_of_k = foot[k];
            if (foot_of_k.face == none) continue;
            FaceDistance::Face const& face = walls.faces[foot_of_k.face];
            Vec2 const from_foot = before[k] - walls.at(foot_of_k, before),
                       up = direction(from_foot);
            Real const height_before = dot(from_foot, up);
            Vec2 const rotation_at_foot =
                direction((1 - foot_of_k.t) * rotation[wall.slot[face.point[0]]] +
                          foot_of_k.t * rotation[wall.slot[face.point[1]]]);
            Vec2 const normal = rotated(up, rotation_at_foot);
            Real const lost = height_before - dot(after[k] - walls.at(foot_of_k, after), normal);
            Real const reached = reach_at(walls, foot_of_k);
            if (!(height_before < reached)) continue;
            points.set(k, after[k] + (amount * lost * fade(height_before / reached)) * normal);
        }
    });
    for (Index k = 0; k < foot.count(); ++k) {
        Index const same = representative[k];  // beyond a cut, whose gap stays
        if (same != k) points.set(k, after[same] + (before[k] - before[same]));
    }
}

}  // namespace harmorph
