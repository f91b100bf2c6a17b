// The C interface: improves the cells of a valid mesh.
#include "apart.hpp"
#include "handles.hpp"
#include "limits.hpp"
#include "morph/quality.hpp"
#include "safe/mesh_improvement.hpp"

namespace harmorph {
namespace {

// Refuses the mesh's own coordinates as the reference after a morph in place: they are then those
// of the mesh that is to be improved.
Status check_own_reference(Plan const& plan, Fault& fault) noexcept {
    Points const own = plan.mesh().points;
    if (coordinates_fingerprint(own, plan.mesh().n_points) ==
        plan.equations().analysed_coordinates())
        return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "the mesh has moved since the analysis; give the coordinates before the "
                        "movement as options.reference");
}

constexpr Limit<hm_improve_options> improve_limits[] = {
    {&hm_improve_options::max_solutions, 0, 10000,
     "options.max_solutions must be between 0 and 10000, not #"},
    {&hm_improve_options::reserved, 0, 0, "options.reserved must be 0, not #"},
};

// Without a given reference, `reference` becomes the mesh's own coordinates.
Status view_improve_options(const hm_improve_options* given, Plan const& plan,
                            ImproveOptions& options, Points& reference, Fault& fault) noexcept {
    hm_improve_options o;
    HARMORPH_TRY(open_options(given, o, "options", "hm_improve_options", fault));
    HARMORPH_TRY(check_limits(o, improve_limits, fault));
    reference = plan.mesh().points;
    if (o.max_solutions != 0) options.max_solutions = o.max_solutions;
    if (o.reference == nullptr) return check_own_reference(plan, fault);
    return view_points(o.reference, "reference", reference, fault);
}

hm_improve_report report_of(ImproveReport const& improved, Quality const& before,
                            Quality const& after, Index base) noexcept {
    hm_improve_report filled = {};
    filled.solutions = improved.solutions;
    filled.movable = improved.unknowns;
    filled.may_improve = improved.converged ? 0 : 1;
    filled.min_quality_before = before.min_quality;
    filled.mean_quality_before = before.mean_quality();
    filled.min_quality_cell_before = numbered(before.min_quality_cell, base);
    filled.min_quality = after.min_quality;
    filled.mean_quality = after.mean_quality();
    filled.min_quality_cell = numbered(after.min_quality_cell, base);
    return filled;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_improve(hm_plan* plan, const hm_points* from, const hm_points_out* to,
                     hm_memory* memory, const hm_improve_options* options,
                     hm_improve_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Plan* p = nullptr;
        Points before, reference;
        MutablePoints after;
        ImproveOptions asked;
        HARMORPH_TRY(open_plan(plan, p, fault));
        MeshImprovement improvement;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { improvement.lay_out(arena, *p); }));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(view_points(from, "from", before, fault));
        HARMORPH_TRY(view_points(to, "to", after, fault));
        HARMORPH_TRY(view_improve_options(options, *p, asked, reference, fault));
        auto const quality_of = [&](Points points) {
            return measure_quality(p->equations().cells(), points, reference, p->executor());
        };
        HARMORPH_TRY(Apart::check_in_place("from", before, "to", after, p->mesh().n_points, fault));
        HARMORPH_TRY(MeshImprovement::check(*p, reference, before, fault));
        Quality const given = quality_of(before);
        ImproveReport improved;
        improvement.run(*p, asked, reference, before, improved);
        // Before anything is written: `to` may be the coordinates of the reference.
        Quality const found = quality_of(as_points(improvement.result));
        improvement.write(after);
        if (report != nullptr)
            write_struct(report_of(improved, given, found, p->mesh().index_base), report);
        return Status::ok;
    });
}

}  // extern "C"
