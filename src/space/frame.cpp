#include "space/frame.hpp"

namespace harmorph {
namespace {

// The default tolerance as a fraction of the extent, the precision of numbers with six digits.
constexpr Real default_tolerance = 1e-5;
// Planes count as parallel if the sine of the angle between them is not above this.
constexpr Real parallel = 1e-4;

// Returns the coordinate of the point in this direction, exactly if the direction is an axis.
Real along(Vec3 point, Vec3 direction) noexcept {
    for (Index axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 1) return point[axis];
    }
    return dot(point, direction);
}

// Returns the axis of the component with the largest magnitude.
Index largest_axis(Vec3 v) noexcept {
    Index axis = abs(v.y) > abs(v.x) ? 1 : 0;
    return abs(v.z) > abs(v[axis]) ? 2 : axis;
}

// A group consists of the points of the faces, or of all other points.
struct Group {
    SpaceMesh const& mesh;
    Span<const std::uint8_t> in_faces;
    std::uint8_t faces;

    // Returns the first point for which visit(point) returns true, or none.
    template <class Visit>
    Index find(Visit visit) const noexcept {
        for (Index k = 0; k < mesh.n_points; ++k) {
            if (in_faces[k] == faces && visit(k)) return k;
        }
        return none;
    }
    // Returns the point for which value(point) is largest.
    template <class Value>
    Index largest(Value value) const noexcept {
        Index best = none;
        Real largest_value = -1;
        find([&](Index k) {
            Real const found = value(mesh.points[k]);
            if (found > largest_value) {
                largest_value = found;
                best = k;
            }
            return false;
        });
        return best;
    }
};

struct FlatPlane {
    bool exists = false;  // false if the points lie on a line, or if there are no points
    Vec3 point, normal;
};

// Returns the plane through three points of the group that are far apart.
FlatPlane plane_through(Group const& group) noexcept {
    FlatPlane flat;
    Index const first = group.find([](Index) { return true; });
    if (first == none) return flat;
    Vec3 const a = group.mesh.points[first];
    Vec3 const b = group.mesh.points[group.largest([&](Vec3 p) { return length(p - a); })];
    Vec3 const line = direction(b - a);
    Vec3 const c =
        group.mesh.points[group.largest([&](Vec3 p) { return length(cross(p - a, line)); })];
    flat.point = a;
    flat.normal = direction(cross(line, c - a));
    flat.exists = length(cross(line, direction(c - a))) > 1e-12;
    return flat;
}

Real extent(SpaceMesh const& mesh) noexcept {
    Real largest = 0;
    for (Index axis = 0; axis < 3; ++axis) {
        Real low = infinity, high = -infinity;
        for (Index k = 0; k < mesh.n_points; ++k) {
            low = min(low, mesh.points[k][axis]);
            high = max(high, mesh.points[k][axis]);
        }
        largest = max(largest, high - low);
    }
    return largest;
}

// If all points have the same z, y or x, within the tolerance, the plane becomes a coordinate
// plane; z is tested first.
void snap_to_coordinates(Group const& group, Real tolerance, FlatPlane& flat) noexcept {
    for (Index axis = 2; axis >= 0; --axis) {
        Real const at = flat.point[axis];
        if (group.find([&](Index k) { return abs(group.mesh.points[k][axis] - at) > tolerance; }) !=
            none)
            continue;
        flat.normal = unit_vector(axis);
        return;
    }
}

Index first_outside(Group const& group, FlatPlane const& flat, Real tolerance) noexcept {
    return group.find([&](Index k) {
        return abs(along(group.mesh.points[k] - flat.point, flat.normal)) > tolerance;
    });
}

void directions_of_planes(FlatPlane const& flat, Frame& frame) noexcept {
    Vec3 n = flat.normal;
    Index const largest = largest_axis(n);
    // The x-y plane gets the normal z, the y-z plane x, and the x-z plane -y.
    if ((n[largest] < 0) != (largest == 1)) n = -1.0 * n;
    Index const first = largest == 0 ? 1 : 0, second = largest == 2 ? 1 : 2;
    Index const axis = abs(n[first]) <= abs(n[second]) ? first : second;
    frame.x = direction(unit_vector(axis) - n[axis] * n);
    frame.y = cross(n, frame.x);
    frame.normal = n;
    frame.origin = along(flat.point, flat.normal) * flat.normal;
}

struct Line {
    Vec3 point, direction;
};

bool contains(FlatPlane const& flat, Line const& line, Real size, Real tolerance) noexcept {
    return abs(along(line.point - flat.point, flat.normal)) <= tolerance &&
           abs(dot(line.direction, flat.normal)) * size <= tolerance;
}

// Returns the intersection of two planes: a coordinate axis, if both planes contain the axis within
// the tolerance.
Line intersection(FlatPlane const& a, FlatPlane const& b, Real size, Real tolerance) noexcept {
    for (Index axis = 0; axis < 3; ++axis) {
        Line const coordinate{{}, unit_vector(axis)};
        if (contains(a, coordinate, size, tolerance) && contains(b, coordinate, size, tolerance))
            return coordinate;
    }
    Vec3 const both = cross(a.normal, b.normal);
    Real const away = dot(b.point - a.point, b.normal) / dot(both, both);
    Vec3 const line = direction(both);
    return {a.point + away * cross(both, a.normal),
            line[largest_axis(line)] < 0 ? -1.0 * line : line};
}

Status directions_of_wedge(Group const& faces, FlatPlane const& flat, Line const& axis,
                           Frame& frame, Fault& fault) noexcept {
    frame.origin = axis.point;
    frame.x = axis.direction;
    frame.y = direction(cross(flat.normal, axis.direction));
    Index const far = faces.largest([&](Vec3 p) { return abs(dot(p - axis.point, frame.y)); });
    if (dot(faces.mesh.points[far] - axis.point, frame.y) < 0) frame.y = -1.0 * frame.y;
    frame.normal = cross(frame.x, frame.y);
    Index const beyond = faces.find(
        [&](Index k) { return frame.in_plane(faces.mesh.points[k]).y < -frame.tolerance; });
    if (beyond == none) return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "the axis of the wedge crosses the mesh: point # is not on the same side "
                        "of the axis as the other points",
                        point_item(beyond));
}

// Sets the line to the axis that the caller gives, which must lie in the plane of the faces.
Status given_axis(SpaceMesh const& mesh, FlatPlane const& flat, Real size, Real tolerance,
                  Line& line, Fault& fault) noexcept {
    line = {mesh.axis_point, direction(mesh.axis)};
    if (!contains(flat, line, size, tolerance)) {
        return fault.refuse(Status::bad_argument,
                            "space.axis does not lie in the plane of the faces");
    }
    return Status::ok;
}

}  // namespace

PlacedPoint Frame::placed(Vec3 point) const noexcept {
    PlacedPoint out;
    if (kind != SpaceKind::wedge) {
        out.place = in_plane(point);
        out.across = dot(point - origin, normal);
        return out;
    }
    Vec3 const from_axis = point - origin;
    Vec2 const radius{dot(from_axis, y), dot(from_axis, normal)};
    Real const r = length(Vec3{radius.x, radius.y, 0});
    out.place = {along(from_axis, x), r};
    if (r > tolerance) out.rotation = (1 / r) * radius;
    out.across = out.rotation.y >= 0 ? 1 - out.rotation.x : 3 + out.rotation.x;
    return out;
}

Vec2 Frame::in_plane(Vec3 point) const noexcept {
    if (kind != SpaceKind::wedge) return {along(point, x), along(point, y)};
    return {along(point - origin, x), along(point - origin, y)};
}

Status find_frame(SpaceMesh const& mesh, Span<const std::uint8_t> in_faces, Frame& frame,
                  Fault& fault) noexcept {
    Group const faces{mesh, in_faces, 1}, others{mesh, in_faces, 0};
    Real const size = extent(mesh);
    frame.tolerance = mesh.tolerance > 0 ? mesh.tolerance : default_tolerance * size;
    FlatPlane flat = plane_through(faces);
    if (!flat.exists)
        return fault.refuse(
            Status::bad_mesh,
            "all points of space.face_points lie on one line, so they define no plane");
    snap_to_coordinates(faces, frame.tolerance, flat);
    Index const outside = first_outside(faces, flat, frame.tolerance);
    if (outside != none) {
        Real const distance = abs(dot(mesh.points[outside] - flat.point, flat.normal));
        return fault.refuse(Status::bad_mesh,
                            "the points of the faces must lie in one plane, but point # is ~ away "
                            "from the plane of the others",
                            point_item(outside), {}, distance);
    }
    FlatPlane const second = plane_through(others);
    bool const second_is_flat =
        second.exists && first_outside(others, second, frame.tolerance) == none;
    bool const inclined = second_is_flat && length(cross(flat.normal, second.normal)) > parallel;
    bool const has_axis = length(mesh.axis) > 0;
    frame.kind = mesh.kind != SpaceKind::found ? mesh.kind
                 : inclined                    ? SpaceKind::wedge
                                               : SpaceKind::planes;
    if (frame.kind == SpaceKind::planes) {
        directions_of_planes(flat, frame);
        return Status::ok;
    }
    if (!has_axis && !inclined) {
        return fault.refuse(Status::bad_argument,
                            "space.axis is 0, and the axis cannot be found, because the other "
                            "points do not lie in one inclined plane; set space.axis");
    }
    Line axis;
    if (has_axis) {
        HARMORPH_TRY(given_axis(mesh, flat, size, frame.tolerance, axis, fault));
    } else {
        axis = intersection(flat, second, size, frame.tolerance);
    }
    return directions_of_wedge(faces, flat, axis, frame, fault);
}

}  // namespace harmorph
