// The C interface: an analysis, a plan and a basis in two blocks, as most programs need them.
#include "handles.hpp"
#include "limits.hpp"

namespace harmorph {
namespace {

// The basis lies in front of the plan: a caller who keeps the functions alone keeps the beginning
// of the block.
struct SolveBlock {
    Basis basis;
    InBlock<Plan> plan;

    void lay_out(Arena& arena, Analysis const& analysis) noexcept {
        basis.lay_out(arena, analysis.basis_counts());
        plan.lay_out(arena, analysis);
    }
};

// Reads the setup, and opens the analysis in it.
Status open_setup(const hm_setup* given, hm_setup& setup, const Analysis*& analysis,
                  CallFault& fault) noexcept {
    HARMORPH_TRY(open_struct(given, setup, "setup", "hm_setup", fault));
    if (setup.analysis != nullptr) return open_complete(setup.analysis, analysis, fault);
    return fault.refuse(Status::bad_argument, "setup.analysis is NULL; call hm_setup_init first");
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_setup_init(hm_setup* setup, hm_memory* memory, const hm_problem* problem,
                        const hm_options* options, hm_error* err) {
    hm_setup made = {};
    hm_status const refused = guarded(err, [&](CallFault& fault) {
        hm_setup old;
        if (asks(memory)) return Status::ok;
        return open_struct(setup, old, "setup", "hm_setup", fault);
    });
    if (refused < 0) return refused;
    hm_status const status = hm_analysis_init(&made.analysis, memory, problem, options, err);
    if (made.analysis == nullptr) return status;  // refused, or a size query
    hm_error reason;
    hm_status const refused_as_incomplete = guarded(&reason, [&](CallFault& fault) {
        const Analysis* analysis = nullptr;
        return open_complete(made.analysis, analysis, fault);
    });
    if (refused_as_incomplete < 0) {
        if (err != nullptr) *err = reason;
        return refused_as_incomplete;
    }
    write_struct(made, setup);
    return status;
}

hm_status hm_setup_solve(hm_setup* setup, hm_memory* memory, hm_solve_report* report,
                         hm_error* err) {
    hm_setup made = {};
    hm_status const status = guarded(err, [&](CallFault& fault) {
        const Analysis* analysis = nullptr;
        HARMORPH_TRY(open_setup(setup, made, analysis, fault));
        SolveBlock placed;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { placed.lay_out(arena, *analysis); }));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        init_basis(placed.basis, analysis->basis_counts(), analysis->basis_source(),
                   analysis->problem().executor);
        placed.plan.object.init(*analysis);
        placed.plan.give(&made.plan);
        made.basis = reinterpret_cast<hm_basis*>(placed.basis.header);
        return Status::ok;
    });
    if (made.plan == nullptr) return status;  // refused, or a size query
    hm_status const factored = hm_plan_factor(made.plan, nullptr, err);
    if (factored < 0) return factored;
    hm_status const solved = hm_plan_solve(made.plan, made.basis, report, err);
    if (solved < 0) return solved;
    write_struct(made, setup);
    return solved;
}

}  // extern "C"
