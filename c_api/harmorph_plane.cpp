// The C interface: finds and moves the plane of a mesh that is one cell thick.
#include "apart.hpp"
#include "handles.hpp"
#include "limits.hpp"
#include "morph/adjoint.hpp"
#include "morph/morph.hpp"
#include "space/plane.hpp"

namespace harmorph {
namespace {

constexpr Limit<hm_space_mesh> space_limits[] = {
    {&hm_space_mesh::kind, HM_SPACE_AUTO, HM_WEDGE,
     "space.kind is #, but it must be HM_SPACE_AUTO, HM_PLANES or HM_WEDGE"},
};

Status view_space(const hm_space_mesh* given, SpaceMesh& mesh, CallFault& fault) noexcept {
    hm_space_mesh m;
    HARMORPH_TRY(require({{"space", given}}, fault));
    HARMORPH_TRY(open_options(given, m, "space", "hm_space_mesh", fault));
    HARMORPH_TRY(check_limits(m, space_limits, fault));
    mesh.index_base = fault.bases.mesh = m.index_base;
    mesh.n_points = m.n_points;
    mesh.points = {m.points.x, m.points.y, m.points.z, stride_of(m.points.stride)};
    mesh.kind = static_cast<SpaceKind>(m.kind);
    mesh.n_faces = m.n_faces;
    mesh.face_start = m.face_start;
    mesh.face_points = m.face_points;
    mesh.n_sides = m.n_sides;
    mesh.side_points = m.side_points;
    mesh.side_markers = m.side_markers;
    mesh.axis_point = {m.axis_point[0], m.axis_point[1], m.axis_point[2]};
    mesh.axis = {m.axis[0], m.axis[1], m.axis[2]};
    mesh.tolerance = m.tolerance;
    return check_counts(mesh, fault);
}

struct PlaneBlock : InBlock<Plane> {
    PlaneSearch search;

    void lay_out(Arena& arena, SpaceMesh const& mesh) noexcept {
        InBlock<Plane>::lay_out(arena, mesh);
        search.lay_out(arena, mesh);
    }
};

// Opens a plane. Handle is hm_plane and Object is Plane; either both are const or neither.
template <class Handle, class Object>
Status open_plane_mesh(Handle* handle, Object*& plane, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"plane", handle}}, fault));
    plane = reinterpret_cast<Object*>(handle);
    fault.bases.mesh = plane->index_base;
    return Status::ok;
}

template <class Given, class View>
Status view_space_points(const Given* given, const char* name, View& points,
                         Fault& fault) noexcept {
    if (given == nullptr) return fault.refuse_argument(name, "% is NULL");
    if (given->x == nullptr || given->y == nullptr || given->z == nullptr) {
        return fault.refuse_argument(name, "%.x, %.y or %.z is NULL");
    }
    if (given->stride < 0) return fault.refuse_argument(name, "%.stride is negative");
    points = {given->x, given->y, given->z, stride_of(given->stride)};
    return Status::ok;
}

// Opens a basis with all functions that belongs to the mesh of the plane. A basis of a list of
// points must have as many points.
Status open_basis_of(Plane const& plane, const hm_basis* handle, Basis& basis,
                     CallFault& fault) noexcept {
    HARMORPH_TRY(open_complete(handle, basis, fault));
    BasisHeader const& header = *basis.header;
    if (basis.n_points() != plane.n_points) {
        return fault.refuse(Status::bad_basis, "the basis has # points, but the plane has @",
                            plain(basis.n_points()), plain(plane.n_points));
    }
    if (header.counts.cells == 0) return Status::ok;
    if (header.counts.cells == plane.n_faces && header.topology.sample == sample_of(plane.mesh()))
        return Status::ok;
    return fault.refuse(Status::bad_basis,
                        "the basis belongs to another mesh, because the cells differ");
}

void add(Apart& arrays, const char* name, SpacePoints points, Index n) noexcept {
    arrays.add(name, points.x, n, points.stride);
    arrays.add(name, points.y, n, points.stride);
    arrays.add(name, points.z, n, points.stride);
}

// Checks the arrays of a call that writes all points: `to` may be the arrays of `from`, which may
// be NULL, but not these arrays from another point on, and must be apart from those of the plane.
Status check_apart(Plane const& plane, Points in_plane, SpacePoints from, MutableSpacePoints to,
                   Fault& fault) noexcept {
    Index const n = plane.n_space_points;
    bool const same =
        from.x == to.x && from.y == to.y && from.z == to.z && from.stride == to.stride;
    Apart arrays;
    arrays.add("displacement", in_plane, plane.n_points);
    if (!same) add(arrays, "from", from, n);
    HARMORPH_TRY(arrays.check("to", to.x, n, fault, to.stride));
    HARMORPH_TRY(arrays.check("to", to.y, n, fault, to.stride));
    return arrays.check("to", to.z, n, fault, to.stride);
}

void put(Vec3 from, double (&to)[3]) noexcept {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_plane_init(hm_plane** plane, hm_memory* memory, const hm_space_mesh* space,
                        hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        SpaceMesh mesh;
        PlaneBlock made;
        HARMORPH_TRY(view_space(space, mesh, fault));
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, mesh); }));
        HARMORPH_TRY(require({{"plane", plane}}, fault));
        HARMORPH_TRY(check_space_mesh(mesh, fault));
        HARMORPH_TRY(made.search.run(mesh, made.object, fault));
        made.give(plane);
        return Status::ok;
    });
}

hm_status hm_plane_info_get(const hm_plane* plane, hm_plane_info* info, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plane* opened = nullptr;
        HARMORPH_TRY(open_plane_mesh(plane, opened, fault));
        HARMORPH_TRY(check_report(info, "info", fault));
        hm_plane_info filled = {};
        filled.kind = static_cast<std::int32_t>(opened->frame.kind);
        filled.n_points = opened->n_points;
        filled.n_space_points = opened->n_space_points;
        filled.layers = opened->layers;
        put(opened->frame.origin, filled.origin);
        put(opened->frame.x, filled.x_direction);
        put(opened->frame.y, filled.y_direction);
        put(opened->frame.normal, filled.normal);
        filled.max_distance = opened->max_distance;
        filled.max_distance_point = numbered(opened->max_distance_point, opened->index_base);
        filled.follows = opened->follows.data();
        filled.space_point = opened->space_point.data();
        write_struct(filled, info);
        return Status::ok;
    });
}

hm_status hm_plane_mesh(const hm_plane* plane, hm_mesh* mesh, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plane* opened = nullptr;
        HARMORPH_TRY(open_plane_mesh(plane, opened, fault));
        HARMORPH_TRY(check_report(mesh, "mesh", fault));
        Mesh const from = opened->mesh();
        hm_mesh filled = {};
        filled.index_base = from.index_base;
        filled.n_points = from.n_points;
        filled.points = {from.points.x, from.points.y, 1};
        filled.cell_layout = static_cast<std::int32_t>(from.layout);
        filled.n_cells = from.n_cells;
        filled.cell_start = from.cell_start;
        filled.cell_points = from.cell_points;
        filled.n_faces = from.n_faces;
        filled.face_points = from.face_points;
        filled.face_markers = from.face_markers;
        write_struct(filled, mesh);
        return Status::ok;
    });
}

hm_status hm_plane_morph(hm_plane* plane, const hm_basis* basis, const double* move,
                         const hm_space_points* from, const hm_space_points_out* to,
                         const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Plane* opened = nullptr;
        Basis b;
        Executor threads;
        SpacePoints before;
        MutableSpacePoints after;
        HARMORPH_TRY(open_plane_mesh(plane, opened, fault));
        HARMORPH_TRY(open_basis_of(*opened, basis, b, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(check_move(b, move, fault));
        if (from != nullptr) HARMORPH_TRY(view_space_points(from, "from", before, fault));
        HARMORPH_TRY(view_space_points(to, "to", after, fault));
        HARMORPH_TRY(check_apart(*opened, {}, before, after, fault));
        MutablePoints const displacement{opened->work_x.data(), opened->work_y.data(), 1};
        morph(b, move, {}, displacement, threads);
        opened->spread(displacement, before, after, threads);
        return Status::ok;
    });
}

hm_status hm_plane_adjoint(hm_plane* plane, const hm_basis* basis, const hm_space_points* dj,
                           double* gradient, const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Plane* opened = nullptr;
        Basis b;
        Executor threads;
        SpacePoints by_points;
        HARMORPH_TRY(require({{"gradient", gradient}}, fault));
        HARMORPH_TRY(open_plane_mesh(plane, opened, fault));
        HARMORPH_TRY(open_basis_of(*opened, basis, b, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(view_space_points(dj, "dj", by_points, fault));
        MutablePoints const sums{opened->work_x.data(), opened->work_y.data(), 1};
        opened->gather(by_points, sums, threads);
        adjoint_morph(b, sums, gradient, threads);
        return Status::ok;
    });
}

hm_status hm_plane_spread(const hm_plane* plane, const hm_points* displacement,
                          const hm_space_points* from, const hm_space_points_out* to,
                          const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plane* opened = nullptr;
        Executor threads;
        Points steps;
        SpacePoints before;
        MutableSpacePoints after;
        HARMORPH_TRY(open_plane_mesh(plane, opened, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(view_points(displacement, "displacement", steps, fault));
        if (from != nullptr) HARMORPH_TRY(view_space_points(from, "from", before, fault));
        HARMORPH_TRY(view_space_points(to, "to", after, fault));
        HARMORPH_TRY(check_apart(*opened, steps, before, after, fault));
        opened->spread(steps, before, after, threads);
        return Status::ok;
    });
}

hm_status hm_plane_gather(const hm_plane* plane, const hm_space_points* dj,
                          const hm_points_out* plane_dj, const hm_executor* executor,
                          hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plane* opened = nullptr;
        Executor threads;
        SpacePoints by_points;
        MutablePoints sums;
        HARMORPH_TRY(open_plane_mesh(plane, opened, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(view_space_points(dj, "dj", by_points, fault));
        HARMORPH_TRY(view_points(plane_dj, "plane_dj", sums, fault));
        Apart arrays;
        add(arrays, "dj", by_points, opened->n_space_points);
        HARMORPH_TRY(arrays.check("plane_dj", sums, opened->n_points, fault));
        opened->gather(by_points, sums, threads);
        return Status::ok;
    });
}

}  // extern "C"
