// The C interface: fields of one mesh at the points of another, and the transpose.
#include "apart.hpp"
#include "handles.hpp"
#include "fields/interpolation.hpp"
#include "harmorph_fields.h"
#include "valid_cells.hpp"

namespace harmorph {
namespace {

constexpr Index max_interpolated = Index{1} << 29;

Status check_count(Index n, Fault& fault) noexcept {
    if (n >= 0 && n <= max_interpolated) return Status::ok;
    return fault.refuse(Status::bad_argument, "n is #, but must be between 0 and 2^29", plain(n));
}

Status check_fields(Index n_fields, Fault& fault) noexcept {
    if (n_fields >= 1) return Status::ok;
    return fault.refuse(Status::bad_argument, "n_fields must be at least 1, not #",
                        plain(n_fields));
}

Status open_interpolation(const hm_interpolation* handle, const Interpolation*& opened,
                          CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"interpolation", handle}}, fault));
    opened = reinterpret_cast<const Interpolation*>(handle);
    fault.bases.mesh = opened->index_base;
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_interpolation_init(hm_interpolation** interpolation, hm_memory* memory,
                                const hm_analysis* analysis, const hm_points* at, int32_t n,
                                const hm_points* to, double* distance, const hm_executor* executor,
                                hm_interpolation_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        Points targets;
        Executor threads;
        HARMORPH_TRY(open_analysis(analysis, opened, fault));
        HARMORPH_TRY(check_count(n, fault));
        InBlock<Interpolation> made;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, *opened, n); }));
        HARMORPH_TRY(require({{"interpolation", interpolation}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        Points points = opened->problem().mesh.points;
        HARMORPH_TRY(view_points_if(at, "at", points, fault));
        HARMORPH_TRY(view_points(to, "to", targets, fault, n));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        Apart arrays;
        arrays.add("at", points, opened->problem().mesh.n_points);
        arrays.add("to", targets, n);
        HARMORPH_TRY(arrays.check("distance", distance, n, fault));
        HARMORPH_TRY(check_range(points, opened->problem().mesh.n_points, fault, threads));
        HARMORPH_TRY(check_range(targets, n, fault, threads));
        HARMORPH_TRY(check_inverted(opened->topology(), points, threads,
                                    "cell # is inverted, so no point can be found in the mesh",
                                    fault));
        Span<Real> distances;
        if (distance != nullptr) distances = {distance, static_cast<Size>(n)};
        Interpolation::Report const found =
            made.object.find(*opened, points, targets, distances, threads);
        made.give(interpolation);
        if (report == nullptr) return Status::ok;
        hm_interpolation_report filled = {};
        filled.outside = found.outside;
        filled.max_distance = found.max_distance;
        filled.max_distance_point = numbered(found.max_distance_point, made.object.index_base);
        write_struct(filled, report);
        return Status::ok;
    });
}

hm_status hm_interpolate(const hm_interpolation* interpolation, int32_t n_fields,
                         const double* from, double* to, const hm_executor* executor,
                         hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Interpolation* opened = nullptr;
        Executor threads;
        HARMORPH_TRY(open_interpolation(interpolation, opened, fault));
        HARMORPH_TRY(require({{"from", from}, {"to", to}}, fault));
        HARMORPH_TRY(check_fields(n_fields, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        Apart arrays;
        arrays.add("from", from, Offset{opened->n_mesh_points} * n_fields);
        HARMORPH_TRY(arrays.check("to", to, Offset{opened->count()} * n_fields, fault));
        for (Index field = 0; field < n_fields; ++field) {
            opened->apply(from + Offset{opened->n_mesh_points} * field,
                          to + Offset{opened->count()} * field, threads);
        }
        return Status::ok;
    });
}

hm_status hm_interpolate_adjoint(const hm_interpolation* interpolation, int32_t n_fields,
                                 const double* to_dj, double* from_dj, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Interpolation* opened = nullptr;
        HARMORPH_TRY(open_interpolation(interpolation, opened, fault));
        HARMORPH_TRY(require({{"to_dj", to_dj}, {"from_dj", from_dj}}, fault));
        HARMORPH_TRY(check_fields(n_fields, fault));
        Apart arrays;
        arrays.add("to_dj", to_dj, Offset{opened->count()} * n_fields);
        HARMORPH_TRY(
            arrays.check("from_dj", from_dj, Offset{opened->n_mesh_points} * n_fields, fault));
        for (Index field = 0; field < n_fields; ++field) {
            opened->add_transpose(to_dj + Offset{opened->count()} * field,
                                  from_dj + Offset{opened->n_mesh_points} * field);
        }
        return Status::ok;
    });
}

}  // extern "C"
