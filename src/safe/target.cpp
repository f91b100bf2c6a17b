#include "safe/target.hpp"

#include "base/predicates.hpp"
#include "base/vec2.hpp"
#include "mesh/cell_shape.hpp"

namespace harmorph {
namespace {

// A loop of the boundary, with the mesh on its left.
struct Loop {
    Span<const Index> point;

    Index next(Index k) const noexcept { return point[k + 1 == point.count() ? 0 : k + 1]; }

    bool is_known(Span<const KnownEnd> ends) const noexcept {
        for (Index const k : point) {
            if (ends[k] == KnownEnd::unknown) return false;
        }
        return true;
    }
    bool moves(Points from, Points to) const noexcept {
        for (Index const k : point) {
            if (from[k].x != to[k].x || from[k].y != to[k].y) return true;
        }
        return false;
    }
    // Returns the sign of the area that the loop encloses. The sign is 0 for a wall without
    // thickness, the area of which is rounding.
    int sense(Points at) const noexcept {
        Vec2 const origin = at[point[0]];
        Real sum = 0, size = 0;
        for (Index k = 0; k < point.count(); ++k) {
            Real const part = cross(at[point[k]] - origin, at[next(k)] - origin);
            sum += part;
            size += abs(part);
        }
        if (abs(sum) <= 1e-9 * size) return 0;
        return sum > 0 ? 1 : -1;
    }
    // Finds on which side of a loop the point p lies, by the number of faces that a ray to the
    // right crosses; the side is `on` if p is on a face.
    enum class Side { outside, inside, on };
    Side side_of(Vec2 p, Points at) const noexcept {
        bool inside = false;
        for (Index k = 0; k < point.count(); ++k) {
            Vec2 const a = at[point[k]], b = at[next(k)];
            Real const low = min(a.y, b.y), high = max(a.y, b.y);
            if (p.y < low || p.y > high) continue;
            int const sign = orientation_sign(a, b, p);
            if (sign == 0 && p.x >= min(a.x, b.x) && p.x <= max(a.x, b.x)) return Side::on;
            bool const spans = (a.y <= p.y) != (b.y <= p.y);
            if (spans && (b.y > a.y ? sign > 0 : sign < 0)) inside = !inside;
        }
        return inside ? Side::inside : Side::outside;
    }
    // Returns on which side of this loop another loop lies that does not cross it.
    Side side_of(Loop const& other, Points at) const noexcept {
        for (Index const k : other.point) {
            Side const side = side_of(at[k], at);
            if (side != Side::on) return side;
        }
        return Side::on;
    }
};

Loop loop_of(Target const& target, Index number) noexcept {
    return {target.faces.points_of_loop(number)};
}

// Loops that do not cross each other must be nested as they were at the start.
Status check_loops(Target const& target, Fault& fault) noexcept {
    Index const n_loops = target.faces.n_loops();
    for (Index number = 0; number < n_loops; ++number) {
        Loop const loop = loop_of(target, number);
        if (loop.point.empty() || !loop.is_known(target.ends)) continue;
        bool const moves = loop.moves(target.start, target.at_target);
        Vec2 const place = target.at_target[loop.point[0]];
        if (moves && loop.sense(target.start) * loop.sense(target.at_target) < 0) {
            return fault.refuse_at(place.x, place.y, Status::crossing,
                                   "the boundary through point # at $ is turned inside out",
                                   point_item(loop.point[0]));
        }
        for (Index other_number = 0; other_number < n_loops; ++other_number) {
            Loop const other = loop_of(target, other_number);
            if (other_number == number || other.point.empty() || !other.is_known(target.ends))
                continue;
            if (!moves && !other.moves(target.start, target.at_target)) continue;
            if (target.faces.share_interface(number, other_number)) continue;
            Loop::Side const before = loop.side_of(other, target.start),
                             after = loop.side_of(other, target.at_target);
            if (before == after || before == Loop::Side::on || after == Loop::Side::on) continue;
            Vec2 const at = target.at_target[other.point[0]];
            return fault.refuse_at(
                at.x, at.y, Status::crossing,
                after == Loop::Side::inside
                    ? "the body through point # at $ is inside the one through point @"
                    : "the body through point # at $ is outside the boundary through point @",
                point_item(other.point[0]), point_item(loop.point[0]));
        }
    }
    return Status::ok;
}

// Only cells at the boundary have corners with three prescribed points.
Status check_corners(Target const& target, Fault& fault) noexcept {
    Index bad_corner = none;
    Mesh const& mesh = target.cells.mesh;
    Index const cell = mesh.find_cell(0, mesh.n_checked(), [&](Index i, Cell shape) {
        if (target.cells.reversed[i] != 0) shape.reverse();
        for (Index k = 0; k < shape.n; ++k) {
            Index const before = k == 0 ? shape.n - 1 : k - 1, next = k + 1 == shape.n ? 0 : k + 1;
            auto const is_known = [&](Index point) {
                return target.ends[point] == KnownEnd::prescribed;
            };
            if (!is_known(shape.point[before]) || !is_known(shape.point[k]) ||
                !is_known(shape.point[next]))
                continue;
            CellShape const at = shape_of(target.cells, i, target.at_target);
            if (orientation_sign(at.at[before], at.at[k], at.at[next]) > 0) continue;
            bad_corner = shape.point[i < mesh.n_cells ? k : 1];
            return true;
        }
        return false;
    });
    if (cell == none) return Status::ok;
    Vec2 const at = target.at_target[bad_corner];
    return fault.refuse_at(
        at.x, at.y, Status::crossing,
        "cell # is inverted by its points on the boundary, at point @ $: a wall rotates too far",
        cell_item(mesh.number(cell)), point_item(bad_corner));
}

// The faces of the walls as they are in a neighbouring period or passage.
struct WallImage {
    FaceDistance const& walls;
    Vec2 shift;
    Index times = 0;  // the multiple of a rotation

    Vec2 of(Vec2 p) const noexcept {
        return times == 0 ? p + shift : walls.rotation.image(p, times);
    }
    // Returns whether the ends of each face lie strictly on both sides of the other face.
    bool cross(Index face, Index other, Points at) const noexcept {
        FaceDistance::Face const &one = walls.faces[face], &two = walls.faces[other];
        Vec2 const a = at[one.point[0]], b = at[one.point[1]], c = of(at[two.point[0]]),
                   d = of(at[two.point[1]]);
        if (max(a.x, b.x) < min(c.x, d.x) || max(c.x, d.x) < min(a.x, b.x)) return false;
        if (max(a.y, b.y) < min(c.y, d.y) || max(c.y, d.y) < min(a.y, b.y)) return false;
        return orientation_sign(a, b, c) * orientation_sign(a, b, d) < 0 &&
               orientation_sign(c, d, a) * orientation_sign(c, d, b) < 0;
    }
};

// The box of all images is tested first, because few faces reach it.
Status check_image(Target const& target, WallImage const& image, Crossing& crossing,
                   Fault& fault) noexcept {
    Points const at = target.at_target;
    FaceDistance const& walls = image.walls;
    Box images;
    for (Index face = 0; face < walls.count; ++face) {
        for (Index const point : walls.faces[face].point) images.include(image.of(at[point]));
    }
    for (Index face = 0; face < walls.count; ++face) {
        Index const(&ends)[2] = walls.faces[face].point;
        Vec2 const a = at[ends[0]], b = at[ends[1]];
        Box box;
        box.include(a);
        box.include(b);
        if (!box.meets(images)) continue;
        for (Index other = 0; other < walls.count; ++other) {
            if (!image.cross(face, other, at) || image.cross(face, other, target.start)) continue;
            Index const(&others)[2] = walls.faces[other].point;
            crossing = {true, {ends[0], ends[1]}, {others[0], others[1]}};
            return fault.refuse_at(
                a.x, a.y, Status::crossing,
                "the moved wall crosses its periodic image: the faces that begin at points # $ "
                "and @",
                point_item(ends[0]), point_item(others[0]));
        }
    }
    return Status::ok;
}

Status check_images(Target const& target, Crossing& crossing, Fault& fault) noexcept {
    if (target.walls == nullptr) return Status::ok;
    FaceDistance const& walls = *target.walls;
    Vec2 shift[Translations::max_shifts];
    Index const n = walls.translations.shifts(target.start, shift);
    for (Index k = 0; k < n; ++k)
        HARMORPH_TRY(check_image(target, {walls, shift[k]}, crossing, fault));
    if (!walls.rotation.any) return Status::ok;
    HARMORPH_TRY(check_image(target, {walls, {}, 1}, crossing, fault));
    return check_image(target, {walls, {}, -1}, crossing, fault);
}

}  // namespace

Status check_target(Target const& target, Crossing& crossing, Fault& fault) noexcept {
    crossing = find_known_crossing(target.faces, target.start, target.at_target, target.ends);
    if (crossing.found) {
        Vec2 const at = target.at_target[crossing.first[0]];
        return fault.refuse_at(
            at.x, at.y, Status::crossing,
            "the moved boundary crosses itself: the faces that begin at points # $ and @",
            point_item(crossing.first[0]), point_item(crossing.second[0]));
    }
    HARMORPH_TRY(check_images(target, crossing, fault));
    HARMORPH_TRY(check_loops(target, fault));
    return check_corners(target, fault);
}

}  // namespace harmorph
