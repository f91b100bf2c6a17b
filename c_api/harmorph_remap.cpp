// The C interface: conservative transfer of fields between the control volumes of two meshes.
#include "handles.hpp"
#include "fields/remap.hpp"
#include "harmorph_fields.h"
#include "valid_cells.hpp"

namespace harmorph {
namespace {

struct RemapCall {
    const Analysis* from = nullptr;
    const Analysis* to = nullptr;
    Index n_fields = 0;
    RemapOrder order = RemapOrder::constant;

    Status open(const hm_analysis* from_handle, const hm_analysis* to_handle, Index fields,
                Index given_order, CallFault& fault) noexcept {
        HARMORPH_TRY(open_analysis(from_handle, from, fault));
        HARMORPH_TRY(open_analysis(to_handle, to, fault));
        if (fields < 1) {
            return fault.refuse(Status::bad_argument, "n_fields must be at least 1, not #",
                                plain(fields));
        }
        if (given_order != 1 && given_order != 2) {
            return fault.refuse(Status::bad_argument, "order must be 1 or 2, not #",
                                plain(given_order));
        }
        n_fields = fields;
        order = static_cast<RemapOrder>(given_order);
        return Status::ok;
    }
    void lay_out(Arena& arena, Remap& remap) const noexcept {
        remap.lay_out(arena, from->problem().mesh, to->problem().mesh, n_fields, order);
    }
};

// Opens the coordinates of one of the meshes and refuses inverted cells there.
Status open_points(Analysis const& analysis, const hm_points* given, const char* name,
                   Executor const& threads, Points& points, CallFault& fault) noexcept {
    Mesh const& mesh = analysis.problem().mesh;
    fault.bases.mesh = mesh.index_base;
    points = mesh.points;
    HARMORPH_TRY(view_points_if(given, name, points, fault));
    HARMORPH_TRY(check_range(points, mesh.n_points, fault, threads));
    return check_inverted(analysis.topology(), points, threads,
                          "cell # is inverted, so its control volumes are not defined", fault);
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_remap_size(const hm_analysis* from, const hm_analysis* to, int32_t n_fields,
                        int32_t order, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RemapCall opened;
        HARMORPH_TRY(opened.open(from, to, n_fields, order, fault));
        Remap remap;
        return count_bytes(bytes, fault, [&](Arena& arena) { opened.lay_out(arena, remap); });
    });
}

hm_status hm_remap(const hm_analysis* from, const hm_points* from_at, const hm_analysis* to,
                   const hm_points* to_at, int32_t n_fields, int32_t order,
                   const double* from_values, double* to_values, double* covered, void* work,
                   size_t bytes, const hm_executor* executor, hm_remap_report* report,
                   hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RemapCall opened;
        Points from_points, to_points;
        Executor threads;
        HARMORPH_TRY(require(
            {{"from_values", from_values}, {"to_values", to_values}, {"covered", covered}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(opened.open(from, to, n_fields, order, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(open_points(*opened.from, from_at, "from_at", threads, from_points, fault));
        HARMORPH_TRY(open_points(*opened.to, to_at, "to_at", threads, to_points, fault));
        Remap remap;
        HARMORPH_TRY(
            place(work, bytes, fault, [&](Arena& arena) { opened.lay_out(arena, remap); }));
        Topology const& source = opened.from->topology();
        Topology const& target = opened.to->topology();
        Remap::Report const found =
            remap.run(source, from_points, target, to_points, {n_fields, from_values, to_values},
                      {covered, static_cast<Size>(target.mesh.n_points)}, threads);
        if (report == nullptr) return Status::ok;
        hm_remap_report filled = {};
        filled.uncovered = found.uncovered;
        filled.partial = found.partial;
        filled.area = found.area;
        write_struct(filled, report);
        return Status::ok;
    });
}

}  // extern "C"
