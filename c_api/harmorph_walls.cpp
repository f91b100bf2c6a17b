// The C interface: distances to the walls of a mesh in any position, and heights of the first
// layer.
#include "apart.hpp"
#include "handles.hpp"
#include "fields/walls.hpp"
#include "harmorph_fields.h"

namespace harmorph {
namespace {

constexpr Index min_points_of_search = 4096;

Status open_walls(const hm_walls* handle, const Walls*& walls, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"walls", handle}}, fault));
    walls = reinterpret_cast<const Walls*>(handle);
    fault.bases.mesh = walls->index_base;
    return Status::ok;
}

// Opens the analysis and counts the faces of the walls, all of whose markers must have some.
Status read_walls(const hm_analysis* handle, Index n_markers, const Index* markers,
                  const Analysis*& analysis, Index& n_faces, CallFault& fault) noexcept {
    HARMORPH_TRY(open_analysis(handle, analysis, fault));
    HARMORPH_TRY(require({{"markers", markers}}, fault));
    if (n_markers < 1) {
        return fault.refuse(Status::bad_argument, "n_markers must be at least 1, not #",
                            plain(n_markers));
    }
    for (Index k = 0; k < n_markers; ++k) {
        if (analysis->boundary().has_marker(markers[k])) continue;
        return fault.refuse(Status::bad_condition, "no face of the boundary has the marker #",
                            marker_item(markers[k]));
    }
    n_faces = Walls::count_faces(analysis->boundary(), {markers, static_cast<Size>(n_markers)});
    return Status::ok;
}

// Walls in the block of the caller.
struct WallsInBlock {
    Span<Walls> in_block;
    Walls walls;
    void lay_out(Arena& arena, Analysis const& analysis, Index n_faces) noexcept {
        arena.take(in_block, 1);
        walls.lay_out(arena, analysis, n_faces);
    }
};

Status check_wall_points(Walls const& walls, Points at, Fault& fault) noexcept {
    for (FaceDistance::Face const& face : walls.tree.faces.first(walls.n_faces())) {
        for (Index const point : face.point) {
            if (is_in_range(at[point])) continue;
            return fault.refuse(Status::bad_mesh,
                                "point # has a coordinate that is not finite or larger than 1e100",
                                point_item(point));
        }
    }
    return Status::ok;
}

// Views n points and faces that hm_wall_distance has found for them.
Status view_feet(Walls const& walls, Index n, const hm_points* points, const Index* face,
                 Points& at, Fault& fault) noexcept {
    if (n < 0)
        return fault.refuse(Status::bad_argument, "n is #, but must not be negative", plain(n));
    HARMORPH_TRY(view_points(points, "points", at, fault, n));
    HARMORPH_TRY(require({{"face", face}}, fault));
    HARMORPH_TRY(check_range(at, n, fault));
    for (Index k = 0; k < n; ++k) {
        Index const number = from_zero(face[k], walls.index_base);
        if (number >= 0 && number < walls.n_faces()) continue;
        return fault.refuse(Status::bad_argument,
                            "entry # of face is @, which is no face of the walls", entry_item(k),
                            plain(face[k]));
    }
    return Status::ok;
}

Vec2 change_of(WallFoot const& foot, FaceDistance::Face const& ends, Points mesh) noexcept {
    return (1 - foot.t) * mesh[ends.point[0]] + foot.t * mesh[ends.point[1]];
}

// Checks the arrays of hm_first_layer, which are wanted unless null.
Status check_layer_arrays(Walls const& walls, Points before, Points at, const double* heights,
                          const double* ratios, const double* angles, Fault& fault) noexcept {
    if (heights == nullptr && ratios == nullptr && angles == nullptr) {
        return fault.refuse_argument("heights",
                                     "%, ratios and angles are NULL, so nothing is wanted");
    }
    if (!before.given() && (ratios != nullptr || angles != nullptr)) {
        return fault.refuse_argument(
            "before", "% is NULL, but ratios and angles compare with the mesh points before");
    }
    Index const n = walls.layer.wall.count;
    Apart arrays;
    arrays.add("before", before, walls.n_points);
    arrays.add("at", at, walls.n_points);
    HARMORPH_TRY(arrays.check("heights", heights, n, fault));
    HARMORPH_TRY(arrays.check("ratios", ratios, n, fault));
    return arrays.check("angles", angles, n, fault);
}

// Checks the points of the first layer, and that a height `before` can be divided by.
Status check_layer(Walls const& walls, Points before, Points at, Fault& fault) noexcept {
    FirstLayer const& layer = walls.layer;
    auto const in_range = [&](Index point) {
        return is_coordinate(at[point]) && (!before.given() || is_coordinate(before[point]));
    };
    for (Index slot = 0; slot < layer.wall.count; ++slot) {
        Index const foot = layer.wall.point[slot], top = layer.above[slot];
        if (in_range(foot) && (top == none || in_range(top))) continue;
        return fault.refuse(Status::bad_mesh,
                            "point # has a coordinate that is not finite or beyond 1e100, in `at` "
                            "or in `before`",
                            point_item(in_range(foot) ? top : foot));
    }
    // A height needs the neighbours of its wall point, which are in range now.
    for (Index slot = 0; slot < layer.wall.count && before.given(); ++slot) {
        if (layer.above[slot] == none || layer.height(slot, before) != 0) continue;
        return fault.refuse(Status::bad_mesh,
                            "the edge from the wall point # into the mesh has no height in "
                            "`before`, so that there is no ratio of heights",
                            point_item(layer.wall.point[slot]));
    }
    return Status::ok;
}

void add_to(MutablePoints points, Index k, Vec2 more) noexcept { points.set(k, points[k] + more); }

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_walls_init(hm_walls** walls, hm_memory* memory, const hm_analysis* analysis,
                        int32_t n_markers, const int32_t* markers, const hm_points* at,
                        hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        Index n_faces = 0;
        HARMORPH_TRY(read_walls(analysis, n_markers, markers, opened, n_faces, fault));
        WallsInBlock made;
        HARMORPH_TRY(
            place(memory, fault, [&](Arena& arena) { made.lay_out(arena, *opened, n_faces); }));
        HARMORPH_TRY(require({{"walls", walls}}, fault));
        Points points = opened->problem().mesh.points;
        HARMORPH_TRY(view_points_if(at, "at", points, fault));
        HARMORPH_TRY(check_range(points, opened->problem().mesh.n_points, fault));
        made.walls.find(*opened, {markers, static_cast<Size>(n_markers)}, points);
        made.in_block[0] = made.walls;
        *walls = reinterpret_cast<hm_walls*>(made.in_block.data());
        return Status::ok;
    });
}

hm_status hm_walls_move(hm_walls* walls, const hm_points* at, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Walls* opened = nullptr;
        Points points;
        HARMORPH_TRY(open_walls(walls, opened, fault));
        HARMORPH_TRY(view_points(at, "at", points, fault));
        HARMORPH_TRY(check_wall_points(*opened, points, fault));
        reinterpret_cast<Walls*>(walls)->move_to(points);
        return Status::ok;
    });
}

hm_status hm_walls_info_get(const hm_walls* walls, hm_walls_info* info, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Walls* opened = nullptr;
        HARMORPH_TRY(open_walls(walls, opened, fault));
        HARMORPH_TRY(check_report(info, "info", fault));
        hm_walls_info filled = {};
        filled.n_faces = opened->n_faces();
        filled.n_wall_points = opened->layer.wall.count;
        filled.face_points = opened->face_point.data();
        filled.face_markers = opened->face_marker.data();
        filled.wall_points = opened->wall_point.data();
        filled.layer_points = opened->above.data();
        write_struct(filled, info);
        return Status::ok;
    });
}

hm_status hm_wall_distance(const hm_walls* walls, int32_t n, const hm_points* points,
                           const int32_t* hint, double* distance, int32_t* face, double* parameter,
                           const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Walls* opened = nullptr;
        Points at;
        Executor threads;
        HARMORPH_TRY(open_walls(walls, opened, fault));
        HARMORPH_TRY(require({{"distance", distance}}, fault));
        if (n < 0)
            return fault.refuse(Status::bad_argument, "n is #, but must not be negative", plain(n));
        HARMORPH_TRY(view_points(points, "points", at, fault, n));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        Apart arrays;
        arrays.add("points", at, n);
        HARMORPH_TRY(arrays.check("distance", distance, n, fault));
        HARMORPH_TRY(arrays.check("parameter", parameter, n, fault));
        HARMORPH_TRY(check_range(at, n, fault, threads));
        Walls const& chosen = *opened;
        auto const hint_of = [&](Index k) {
            if (hint == nullptr) return none;
            Index const number = from_zero(hint[k], chosen.index_base);
            return number >= 0 && number < chosen.n_faces() ? number : none;
        };
        threads.for_ranges(n, min_points_of_search, [&](Index begin, Index end) {
            chosen.tree.find_nearest(at, begin, end, hint_of, [&](Index k, Index nearest) {
                WallFoot const foot = chosen.place_on(nearest, at[k]);
                distance[k] = foot.distance;
                if (face != nullptr) face[k] = nearest + chosen.index_base;
                if (parameter != nullptr) parameter[k] = foot.t;
            });
        });
        return Status::ok;
    });
}

hm_status hm_wall_distance_change(const hm_walls* walls, int32_t n, const hm_points* points,
                                  const int32_t* face, const hm_points* point_change,
                                  const hm_points* mesh_change, double* change, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Walls* opened = nullptr;
        Points at, of_points, of_mesh;
        HARMORPH_TRY(open_walls(walls, opened, fault));
        HARMORPH_TRY(require({{"change", change}}, fault));
        HARMORPH_TRY(view_feet(*opened, n, points, face, at, fault));
        HARMORPH_TRY(view_points_if(point_change, "point_change", of_points, fault, n));
        HARMORPH_TRY(view_points_if(mesh_change, "mesh_change", of_mesh, fault));
        Apart arrays;
        arrays.add("points", at, n);
        arrays.add("point_change", of_points, n);
        arrays.add("mesh_change", of_mesh, opened->n_points);
        HARMORPH_TRY(arrays.check("change", change, n, fault));
        for (Index k = 0; k < n; ++k) {
            WallFoot const foot = opened->foot_on(from_zero(face[k], opened->index_base), at[k]);
            Vec2 total = of_points.given() ? of_points[k] : Vec2{};
            if (of_mesh.given())
                total = total - change_of(foot, opened->tree.faces[foot.face], of_mesh);
            change[k] = dot(foot.normal, total);
        }
        return Status::ok;
    });
}

hm_status hm_wall_distance_adjoint(const hm_walls* walls, int32_t n, const hm_points* points,
                                   const int32_t* face, const double* dj,
                                   const hm_points_out* point_dj, const hm_points_out* mesh_dj,
                                   hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Walls* opened = nullptr;
        Points at;
        MutablePoints of_points, of_mesh;
        HARMORPH_TRY(open_walls(walls, opened, fault));
        HARMORPH_TRY(require({{"dj", dj}}, fault));
        HARMORPH_TRY(view_feet(*opened, n, points, face, at, fault));
        if (point_dj != nullptr)
            HARMORPH_TRY(view_points(point_dj, "point_dj", of_points, fault, n));
        if (mesh_dj != nullptr) HARMORPH_TRY(view_points(mesh_dj, "mesh_dj", of_mesh, fault));
        Apart arrays;
        arrays.add("points", at, n);
        arrays.add("dj", dj, n);
        bool const same = of_points.x == of_mesh.x && of_points.y == of_mesh.y &&
                          of_points.stride == of_mesh.stride;
        Index const n_both = same ? max(n, opened->n_points) : n;
        HARMORPH_TRY(arrays.check("point_dj", of_points, n_both, fault));
        if (!same) HARMORPH_TRY(arrays.check("mesh_dj", of_mesh, opened->n_points, fault));
        for (Index k = 0; k < n; ++k) {
            WallFoot const foot = opened->foot_on(from_zero(face[k], opened->index_base), at[k]);
            Vec2 const by_point = dj[k] * foot.normal;
            if (of_points.given()) add_to(of_points, k, by_point);
            if (!of_mesh.given()) continue;
            FaceDistance::Face const& ends = opened->tree.faces[foot.face];
            add_to(of_mesh, ends.point[0], (foot.t - 1) * by_point);
            add_to(of_mesh, ends.point[1], -foot.t * by_point);
        }
        return Status::ok;
    });
}

hm_status hm_first_layer(const hm_walls* walls, const hm_points* before, const hm_points* at,
                         double* heights, double* ratios, double* angles, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Walls* opened = nullptr;
        Points start, points;
        HARMORPH_TRY(open_walls(walls, opened, fault));
        HARMORPH_TRY(view_points_if(before, "before", start, fault));
        HARMORPH_TRY(view_points(at, "at", points, fault));
        HARMORPH_TRY(check_layer_arrays(*opened, start, points, heights, ratios, angles, fault));
        HARMORPH_TRY(check_layer(*opened, start, points, fault));
        if (heights != nullptr)
            opened->heights(points, {heights, static_cast<Size>(opened->layer.wall.count)});
        if (ratios == nullptr && angles == nullptr) return Status::ok;
        FirstLayer const& layer = opened->layer;
        for (Index slot = 0; slot < layer.wall.count; ++slot) {
            LayerChange change;
            if (layer.above[slot] != none) change = change_of(layer, slot, start, points);
            if (ratios != nullptr) ratios[slot] = change.ratio;
            if (angles != nullptr) angles[slot] = change.angle;
        }
        return Status::ok;
    });
}

}  // extern "C"
