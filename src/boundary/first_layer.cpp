#include "boundary/first_layer.hpp"

#include "base/angle.hpp"

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

Vec2 WallPoints::turn(Index at_slot, Points before, Points after) const noexcept {
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
        sum = sum + weight[face] * direction(turn_between(old_side, new_side));
    }
    Vec2 const turn = direction(sum);
    return turn.x == 0 && turn.y == 0 ? Vec2{1, 0} : turn;
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

FirstLayerChange compare(FirstLayer const& layer, Points before, Points after) noexcept {
    FirstLayerChange change;
    for (Index slot = 0; slot < layer.wall.count; ++slot) {
        if (layer.above[slot] == none) continue;
        Index const foot = layer.wall.point[slot], top = layer.above[slot];
        Vec2 const turn = layer.wall.turn(slot, before, after);
        Vec2 const normal = left_of(direction(layer.wall.tangent(slot, before)));
        Vec2 const old_edge = before[top] - before[foot],
                   new_edge = turned_back(after[top] - after[foot], turn);
        Real const angle =
            in_degrees(abs(angle_of(turn_between(direction(old_edge), direction(new_edge)))));
        Real const ratio = dot(new_edge, normal) / dot(old_edge, normal);
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

}  // namespace harmorph
