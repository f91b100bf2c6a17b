#include "space/space_mesh.hpp"

#include "mesh/mesh.hpp"

namespace harmorph {
namespace {

Status check_rows(SpaceMesh const& mesh, Fault& fault) noexcept {
    if (mesh.face_start == nullptr) return Status::ok;
    if (mesh.face_start[0] != mesh.index_base) {
        return fault.refuse(Status::bad_mesh, "space.face_start must begin with index_base, not #",
                            plain(mesh.face_start[0]));
    }
    for (Index i = 0; i < mesh.n_faces; ++i) {
        Offset const n = Offset{mesh.face_start[i + 1]} - mesh.face_start[i];
        if (n >= 3 && n <= SpaceMesh::max_corners) continue;
        return fault.refuse(Status::bad_mesh, "face # has ~ points, but must have 3 to 1024",
                            cell_item(i), {}, static_cast<Real>(n));
    }
    return Status::ok;
}

Status check_faces(SpaceMesh const& mesh, Fault& fault) noexcept {
    for (Index i = 0; i < mesh.n_faces; ++i) {
        SpaceFace const face = mesh.face(i);
        for (Index k = 0; k < face.n; ++k) {
            if (face.point(k) >= 0 && face.point(k) < mesh.n_points) continue;
            return fault.refuse(Status::bad_mesh, "face # names point @, which does not exist",
                                cell_item(i), point_item(face.point(k)));
        }
    }
    for (Index i = 0; i < mesh.n_sides; ++i) {
        for (Index k = 0; k < 4; ++k) {
            Index const point = from_zero(mesh.side_points[Offset{4} * i + k], mesh.index_base);
            if (point >= 0 && point < mesh.n_points) continue;
            return fault.refuse(Status::bad_mesh, "side # names point @, which does not exist",
                                side_item(i), point_item(point));
        }
    }
    return Status::ok;
}

Status check_coordinates(SpaceMesh const& mesh, Fault& fault) noexcept {
    for (Index k = 0; k < mesh.n_points; ++k) {
        Vec3 const p = mesh.points[k];
        if (!is_finite(p.x) || !is_finite(p.y) || !is_finite(p.z)) {
            return fault.refuse(Status::bad_mesh, "point # has a coordinate that is not finite",
                                point_item(k));
        }
        Real const size = max(max(abs(p.x), abs(p.y)), abs(p.z));
        if (size <= largest_coordinate) continue;
        return fault.refuse(Status::bad_mesh,
                            "point # has the coordinate ~, which is larger than the limit of 1e100",
                            point_item(k), {}, size);
    }
    return Status::ok;
}

bool are_finite(Vec3 p) noexcept { return is_finite(p.x) && is_finite(p.y) && is_finite(p.z); }

}  // namespace

SpaceFace SpaceMesh::face(Index i) const noexcept {
    Offset const begin = face_start == nullptr ? Offset{4} * i : Offset{face_start[i]} - index_base;
    Index const n = face_start == nullptr ? 4 : face_start[i + 1] - face_start[i];
    SpaceFace out{n, face_points + begin, index_base};
    if (n == 4 && out.number[3] == out.number[2]) out.n = 3;
    return out;
}

Status check_counts(SpaceMesh const& mesh, Fault& fault) noexcept {
    if (mesh.index_base != 0 && mesh.index_base != 1) {
        return fault.refuse(Status::bad_argument, "space.index_base must be 0 or 1, not #",
                            plain(mesh.index_base));
    }
    if (mesh.n_points < 3 || mesh.n_points > SpaceMesh::max_points) {
        return fault.refuse(Status::bad_mesh, "space.n_points must be between 3 and 2^30, not #",
                            plain(mesh.n_points));
    }
    if (mesh.n_faces < 1 || mesh.n_faces > SpaceMesh::max_faces) {
        return fault.refuse(Status::bad_mesh, "space.n_faces must be between 1 and 2^29, not #",
                            plain(mesh.n_faces));
    }
    if (mesh.n_sides < 0 || mesh.n_sides > SpaceMesh::max_faces) {
        return fault.refuse(Status::bad_argument, "space.n_sides must be between 0 and 2^29, not #",
                            plain(mesh.n_sides));
    }
    if (mesh.n_corners() < 3 || mesh.n_corners() > Offset{INT32_MAX} - 1) {
        return fault.refuse(Status::bad_mesh,
                            "by space.face_start the faces have ~ corners, but there must be 3 to "
                            "2^31 - 2",
                            {}, {}, static_cast<Real>(mesh.n_corners()));
    }
    return Status::ok;
}

Status check_space_mesh(SpaceMesh const& mesh, Fault& fault) noexcept {
    HARMORPH_TRY(check_counts(mesh, fault));
    if (mesh.points.x == nullptr || mesh.points.y == nullptr || mesh.points.z == nullptr) {
        return fault.refuse(Status::bad_argument,
                            "space.points.x, space.points.y or space.points.z is NULL");
    }
    if (mesh.points.stride < 1)
        return fault.refuse(Status::bad_argument, "space.points.stride is negative");
    if (mesh.face_points == nullptr)
        return fault.refuse(Status::bad_argument, "space.face_points is NULL");
    if (mesh.n_sides > 0 && (mesh.side_points == nullptr || mesh.side_markers == nullptr)) {
        return fault.refuse(Status::bad_argument,
                            "space.side_points or space.side_markers is NULL");
    }
    if (!is_finite(mesh.tolerance) || mesh.tolerance < 0) {
        return fault.refuse(Status::bad_argument,
                            "space.tolerance must be a length of 0 or more, not ~", {}, {},
                            mesh.tolerance);
    }
    bool const finite = are_finite(mesh.axis) && are_finite(mesh.axis_point);
    bool const has_axis = finite && (length(mesh.axis) > 0 || length(mesh.axis_point) > 0);
    if (!finite || (has_axis && mesh.kind != SpaceKind::wedge)) {
        return fault.refuse(Status::bad_argument,
                            "space.axis and space.axis_point must be finite, and 0 unless the kind "
                            "is HM_WEDGE");
    }
    HARMORPH_TRY(check_rows(mesh, fault));
    HARMORPH_TRY(check_faces(mesh, fault));
    return check_coordinates(mesh, fault);
}

}  // namespace harmorph
