// The C interface: the plan of an analysis and a basis for its solution; factorisation and
// solution.
#include "handles.hpp"
#include "basis/basis_measures.hpp"

namespace harmorph {
namespace {

hm_solve_report report_of(SolveReport const& solved, Basis const& basis,
                          Plan const& plan) noexcept {
    Mesh const& mesh = plan.mesh();
    BasisMeasures const measures = measure_basis(basis, mesh.points, plan.executor());
    hm_solve_report filled = {};
    filled.unknowns = solved.unknowns;
    filled.functions = solved.functions;
    filled.residual = solved.residual;
    filled.residual_function = solved.residual_function;
    filled.boundary_error_point = numbered(measures.value.point, mesh.index_base);
    filled.boundary_error = measures.value.error;
    filled.partition_defect = measures.partition_defect;
    filled.min_value = measures.min_value;
    filled.max_value = measures.max_value;
    filled.max_distance = measures.distance.error;
    filled.max_distance_point = numbered(measures.distance.point, mesh.index_base);
    filled.curve_points = basis.wall_point.count();
    filled.refinements = solved.refinements;
    filled.factor_entries = solved.factor_entries;
    filled.iterations = solved.iteration.iterations;
    filled.levels = solved.iteration.levels;
    filled.work = solved.iteration.work;
    return filled;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_plan_init(hm_plan** plan, hm_memory* memory, const hm_analysis* analysis,
                       hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        InBlock<Plan> made;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, *opened); }));
        HARMORPH_TRY(require({{"plan", plan}}, fault));
        made.object.init(*opened);
        made.give(plan);
        return Status::ok;
    });
}

hm_status hm_basis_init(hm_basis** basis, hm_memory* memory, const hm_analysis* analysis,
                        hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        return make_basis(*opened, opened->basis_counts(), memory, basis, fault);
    });
}

hm_status hm_plan_factor(hm_plan* plan, const hm_points* at, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Plan* p = nullptr;
        HARMORPH_TRY(open_plan(plan, p, fault));
        Points points = p->mesh().points;
        HARMORPH_TRY(view_points_if(at, "at", points, fault));
        return p->factor(points, fault);
    });
}

hm_status hm_plan_solve(hm_plan* plan, hm_basis* basis, hm_solve_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Plan* p = nullptr;
        Basis b;
        HARMORPH_TRY(open_basis(basis, b, fault));
        HARMORPH_TRY(open_plan(plan, p, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        SolveReport solved;
        HARMORPH_TRY(p->solve(b, solved, fault));
        if (report != nullptr) write_struct(report_of(solved, b, *p), report);
        return fault.status;
    });
}

hm_status hm_plan_points(const hm_plan* plan, int32_t* n_points, int32_t* index_base,
                         hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plan* p = nullptr;
        HARMORPH_TRY(open_plan(plan, p, fault));
        HARMORPH_TRY(require({{"n_points", n_points}, {"index_base", index_base}}, fault));
        *n_points = p->mesh().n_points;
        *index_base = p->mesh().index_base;
        return Status::ok;
    });
}

hm_status hm_plan_level(const hm_plan* plan, int32_t level, int32_t* cells, int32_t* n_cells,
                        hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plan* p = nullptr;
        HARMORPH_TRY(open_plan(plan, p, fault));
        HARMORPH_TRY(require({{"cells", cells}, {"n_cells", n_cells}}, fault));
        return p->level_cells(level, {cells, static_cast<Size>(p->mesh().n_points)}, *n_cells,
                              fault);
    });
}

}  // extern "C"
