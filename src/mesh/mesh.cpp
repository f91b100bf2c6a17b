#include "mesh/mesh.hpp"

#include "base/executor.hpp"
#include "base/vec2.hpp"

namespace harmorph {
namespace {

// Checks the n points point_of(k) of cell i.
template <class PointOf>
Status check_cell(Mesh const& mesh, Index i, Index n, PointOf point_of, Fault& fault) noexcept {
    for (Index k = 0; k < n; ++k) {
        Index const point = point_of(k);
        if (point < 0 || point >= mesh.n_points) {
            return fault.refuse(Status::bad_mesh, "cell # names point @, which does not exist",
                                cell_item(i), point_item(point));
        }
        for (Index earlier = 0; earlier < k; ++earlier) {
            if (point_of(earlier) != point) continue;
            return fault.refuse(Status::bad_mesh, "cell # contains point @ twice", cell_item(i),
                                point_item(point));
        }
    }
    return Status::ok;
}

Status check_cells(Mesh const& mesh, Fault& fault, Executor const& executor) noexcept {
    if (mesh.layout == CellLayout::structured || mesh.layout == CellLayout::blocks)
        return Status::ok;
    if (mesh.layout == CellLayout::polygons) {
        for (Index i = 0; i < mesh.n_cells; ++i) {
            const Index* const corner =
                mesh.cell_points + (Offset{mesh.cell_start[i]} - mesh.index_base);
            auto const point_of = [&](Index k) { return from_zero(corner[k], mesh.index_base); };
            HARMORPH_TRY(
                check_cell(mesh, i, mesh.cell_start[i + 1] - mesh.cell_start[i], point_of, fault));
        }
        return Status::ok;
    }
    Index const i = find_in_ranges(mesh.n_cells, executor, [&](Index begin, Index end) {
        Fault any;
        return mesh.find_cell(begin, end, [&](Index number, Cell const& cell) {
            return failed(check_cell(
                mesh, number, cell.n, [&](Index k) { return cell.point[k]; }, any));
        });
    });
    if (i == none) return Status::ok;
    Cell const bad = mesh.cell(i);
    return check_cell(
        mesh, i, bad.n, [&](Index k) { return bad.point[k]; }, fault);
}

// Checks that the sizes of all blocks add up to n_points and n_cells.
Status check_blocks(Mesh const& mesh, Fault& fault) noexcept {
    Offset points = 0, cells = 0;
    for (Index b = 0; b < mesh.n_blocks; ++b) {
        Offset const ni = mesh.block_sizes[2 * b], nj = mesh.block_sizes[2 * b + 1];
        if (ni < 2 || nj < 2 || ni * nj > Mesh::max_points) {
            return fault.refuse(Status::bad_mesh,
                                "block # has ni or nj below 2, or has more than 2^30 points",
                                block_item(b));
        }
        points += ni * nj;
        cells += (ni - 1) * (nj - 1);
    }
    if (points != mesh.n_points) {
        return fault.refuse(Status::bad_mesh,
                            "all blocks together have ~ points, but mesh.n_points is #",
                            plain(mesh.n_points), {}, static_cast<Real>(points));
    }
    if (cells != mesh.n_cells) {
        return fault.refuse(Status::bad_mesh,
                            "all blocks together have ~ cells, but mesh.n_cells is #",
                            plain(mesh.n_cells), {}, static_cast<Real>(cells));
    }
    return Status::ok;
}

Status check_boundary(Mesh const& mesh, Fault& fault) noexcept {
    if (mesh.n_faces > 0 && (mesh.face_points == nullptr || mesh.face_markers == nullptr)) {
        return fault.refuse(Status::bad_argument, "mesh.face_points or mesh.face_markers is NULL");
    }
    if (mesh.n_lists > 0 && (mesh.list_start == nullptr || mesh.list_points == nullptr ||
                             mesh.list_markers == nullptr)) {
        return fault.refuse(Status::bad_argument,
                            "mesh.list_start, mesh.list_points or mesh.list_markers is NULL");
    }
    for (Index list = 0; list < mesh.n_lists; ++list) {
        if (mesh.list_start[0] != mesh.index_base ||
            mesh.list_start[list + 1] < mesh.list_start[list]) {
            return fault.refuse(Status::bad_mesh,
                                "mesh.list_start must begin with index_base and must not decrease; "
                                "the error is at list #",
                                list_item(list));
        }
    }
    auto const points_exist = [&](BoundaryFace face, Index list, Index number) {
        Index const ends[] = {face.begin, face.end};
        for (Index point : ends) {
            if (point >= 0 && point < mesh.n_points) continue;
            fault.refuse(Status::bad_mesh,
                         list == none
                             ? "boundary face # names point @, which does not exist"
                             : "entry # of mesh.list_points names point @, which does not exist",
                         list == none ? side_item(number) : entry_item(number), point_item(point));
            return false;
        }
        return true;
    };
    return mesh.for_each_face(points_exist) ? Status::ok : fault.status;
}

Status check_coordinates(Mesh const& mesh, Fault& fault, Executor const& executor) noexcept {
    if (mesh.points.x == nullptr || mesh.points.y == nullptr) {
        return fault.refuse(Status::bad_argument, "mesh.points.x or mesh.points.y is NULL");
    }
    if (mesh.points.stride < 1)
        return fault.refuse(Status::bad_argument, "mesh.points.stride is negative");
    return check_range(mesh.points, mesh.n_points, fault, executor);
}

}  // namespace

Status check_range(Points points, Index n_points, Fault& fault, Executor const& executor) noexcept {
    Index const k = find_in_ranges(n_points, executor, [&](Index begin, Index end) {
        for (Index point = begin; point < end; ++point) {
            if (!is_coordinate(points[point])) return point;
        }
        return none;
    });
    if (k == none) return Status::ok;
    Vec2 const p = points[k];
    if (!is_finite(p.x) || !is_finite(p.y)) {
        return fault.refuse(Status::bad_mesh, "point # has a coordinate that is not finite",
                            point_item(k));
    }
    return fault.refuse(Status::bad_mesh,
                        "point # has the coordinate ~, which is larger than the limit of 1e100",
                        point_item(k), {}, abs(p.x) > abs(p.y) ? p.x : p.y);
}

Status check_counts(Mesh const& mesh, Fault& fault) noexcept {
    if (mesh.index_base != 0 && mesh.index_base != 1) {
        return fault.refuse(Status::bad_argument, "mesh.index_base must be 0 or 1, not #",
                            plain(mesh.index_base));
    }
    if (mesh.n_points < 3 || mesh.n_points > Mesh::max_points) {
        return fault.refuse(Status::bad_mesh, "mesh.n_points must be between 3 and 2^30, not #",
                            plain(mesh.n_points));
    }
    bool const blocks = mesh.layout == CellLayout::blocks;
    if (mesh.n_blocks < (blocks ? 1 : 0) || mesh.n_blocks > (blocks ? Mesh::max_blocks : 0)) {
        return fault.refuse(Status::bad_argument,
                            blocks ? "mesh.n_blocks must be between 1 and 65536, not #"
                                   : "mesh.n_blocks is #, but must be 0, as only the layout "
                                     "HM_CELLS_BLOCKS has blocks",
                            plain(mesh.n_blocks));
    }
    if (blocks && mesh.block_sizes == nullptr) {
        return fault.refuse(Status::bad_argument, "mesh.block_sizes is NULL");
    }
    if (mesh.n_cells < 1 || mesh.n_cells > Mesh::max_cells) {
        return fault.refuse(Status::bad_mesh, "mesh.n_cells must be between 1 and 2^29, not #",
                            plain(mesh.n_cells));
    }
    bool const mixed = mesh.layout == CellLayout::mixed;
    if (mesh.n_quads < 0 || mesh.n_quads > (mixed ? mesh.n_cells : 0)) {
        return fault.refuse(
            Status::bad_argument,
            mixed ? "mesh.n_quads must be between 0 and mesh.n_cells, not #"
                  : "mesh.n_quads is #, but must be 0, as only the layout HM_CELLS_MIXED has a "
                    "separate array of quads",
            plain(mesh.n_quads));
    }
    if (mesh.n_faces < 0 || mesh.n_lists < 0) {
        return fault.refuse(Status::bad_argument,
                            "mesh.n_faces and mesh.n_lists must not be negative");
    }
    return Status::ok;
}

// Checks cell_start: each cell must have 3 to max_corners points. Otherwise `refusal` is the text
// of the error.
Status check_rows(Mesh const& mesh, Index max_corners, const char* refusal, Fault& fault) noexcept {
    if (mesh.cell_start == nullptr)
        return fault.refuse(Status::bad_argument, "mesh.cell_start is NULL");
    if (mesh.cell_start[0] != mesh.index_base) {
        return fault.refuse(Status::bad_mesh, "mesh.cell_start must begin with index_base, not #",
                            plain(mesh.cell_start[0]));
    }
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Offset const n = Offset{mesh.cell_start[i + 1]} - mesh.cell_start[i];
        if (n >= 3 && n <= max_corners) continue;
        return fault.refuse(Status::bad_mesh, refusal, cell_item(i), {}, static_cast<Real>(n));
    }
    return Status::ok;
}

Status check_polygons(Mesh const& mesh, Fault& fault) noexcept {
    if (mesh.layout != CellLayout::polygons) return Status::ok;
    HARMORPH_TRY(check_rows(mesh, Mesh::max_corners,
                            "polygon # has ~ points, but must have 3 to 1024", fault));
    if (mesh.n_corners() <= Mesh::max_cells) return Status::ok;
    return fault.refuse(Status::bad_mesh, "all polygons together have more than 2^29 corners");
}

Status check_layout(Mesh const& mesh, Fault& fault) noexcept {
    if (mesh.layout == CellLayout::structured) {
        if (mesh.ni < 2 || mesh.nj < 2 || Offset{mesh.ni} * mesh.nj != mesh.n_points) {
            return fault.refuse(
                Status::bad_mesh,
                "a structured mesh needs ni, nj >= 2 and ni*nj = n_points, but ni is # and nj is @",
                plain(mesh.ni), plain(mesh.nj));
        }
        if (Offset{mesh.ni - 1} * (mesh.nj - 1) != mesh.n_cells) {
            return fault.refuse(Status::bad_mesh,
                                "a structured mesh has (ni-1)*(nj-1) cells, but mesh.n_cells is #",
                                plain(mesh.n_cells));
        }
        return Status::ok;
    }
    if (mesh.layout == CellLayout::blocks) return check_blocks(mesh, fault);
    HARMORPH_TRY(check_polygons(mesh, fault));
    if (mesh.n_triangles() > 0 && mesh.cell_points == nullptr) {
        return fault.refuse(Status::bad_argument, "mesh.cell_points is NULL");
    }
    if (mesh.n_quads > 0 && mesh.quad_points == nullptr) {
        return fault.refuse(Status::bad_argument, "mesh.quad_points is NULL");
    }
    if (mesh.layout != CellLayout::rows) return Status::ok;
    return check_rows(mesh, 4, "cell # has ~ points, but must have 3 or 4", fault);
}

Status check_mesh(Mesh const& mesh, Fault& fault, Executor const& executor) noexcept {
    HARMORPH_TRY(check_counts(mesh, fault));
    HARMORPH_TRY(check_layout(mesh, fault));
    HARMORPH_TRY(check_cells(mesh, fault, executor));
    HARMORPH_TRY(check_boundary(mesh, fault));
    return check_coordinates(mesh, fault, executor);
}

Real cell_area(Cell const& cell, Points points) noexcept {
    Vec2 const a = points[cell.point[0]], b = points[cell.point[1]], c = points[cell.point[2]];
    if (cell.n == 3) return triangle_area(a, b, c);
    return 0.5 * cross(c - a, points[cell.point[3]] - b);
}

}  // namespace harmorph
