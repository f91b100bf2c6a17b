// The C interface: swept areas between two positions of a mesh.
#include "apart.hpp"
#include "views.hpp"
#include "fields/swept_areas.hpp"
#include "harmorph_fields.h"

using namespace harmorph;

extern "C" {

hm_status hm_swept_count(const hm_mesh* mesh, int64_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Mesh view;
        HARMORPH_TRY(require({{"n", n}}, fault));
        HARMORPH_TRY(view_mesh(mesh, view, fault));
        HARMORPH_TRY(check_layout(view, fault));
        *n = SweptAreas::count_entries(view);
        return Status::ok;
    });
}

hm_status hm_swept_areas(const hm_mesh* mesh, const hm_points* from, const hm_points* to,
                         double* sides, double* duals, double* halves, const hm_executor* executor,
                         hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Mesh view;
        Executor threads;
        Points start, target;
        HARMORPH_TRY(view_mesh(mesh, view, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(check_mesh(view, fault, threads));
        start = view.points;
        HARMORPH_TRY(view_points_if(from, "from", start, fault));
        HARMORPH_TRY(view_points(to, "to", target, fault));
        if (sides == nullptr && duals == nullptr && halves == nullptr) {
            return fault.refuse(Status::bad_argument,
                                "sides, duals and halves are all NULL; ask for at least one array");
        }
        Offset const entries = SweptAreas::count_entries(view);
        Apart arrays;
        arrays.add("from", start, view.n_points);
        arrays.add("to", target, view.n_points);
        HARMORPH_TRY(arrays.check("sides", sides, entries, fault));
        HARMORPH_TRY(arrays.check("duals", duals, entries, fault));
        HARMORPH_TRY(arrays.check("halves", halves, 2 * entries, fault));
        HARMORPH_TRY(check_range(start, view.n_points, fault, threads));
        HARMORPH_TRY(check_range(target, view.n_points, fault, threads));
        Size const n = static_cast<Size>(entries);
        SweptAreas areas;
        if (sides != nullptr) areas.sides = {sides, n};
        if (duals != nullptr) areas.duals = {duals, n};
        if (halves != nullptr) areas.halves = {halves, 2 * n};
        areas.compute(view, start, target, threads);
        return Status::ok;
    });
}

}  // extern "C"
