#include "fixtures/options.hpp"
#include "ours.hpp"

#include "clock.hpp"

namespace bench {

// The progress callback: a phase lasts from its fraction 0 to its fraction 1.
struct Ours::Clock {
    Stopwatch watch;
    double begin = 0;
    Phases phases;

    double* seconds_of(Index phase) {
        switch (phase) {
            case HM_PHASE_STRUCTURE: return &phases.structure;
            case HM_PHASE_ORDERING: return &phases.ordering;
            case HM_PHASE_SYMBOLIC: return &phases.symbolic;
            case HM_PHASE_ASSEMBLY: return &phases.assembly;
            case HM_PHASE_FACTOR: return &phases.factor;
            case HM_PHASE_SOLVE: return &phases.solve;
            case HM_PHASE_RESIDUAL: return &phases.residual;
            default: return nullptr;
        }
    }
    static Index told(void* user, Index phase, double fraction) {
        Clock& self = *static_cast<Clock*>(user);
        double* const seconds = self.seconds_of(phase);
        if (seconds == nullptr) return 0;
        if (fraction <= 0) self.begin = self.watch.seconds();
        if (fraction >= 1) *seconds += self.watch.seconds() - self.begin;
        return 0;
    }
};

Ours::Ours(Case const& mesh_case, Workspace& workspace, Index functions,
           hm_executor const* executor, Index engine, Index precision, Index operator_kind)
    : case_(mesh_case),
      workspace_(workspace),
      functions_(functions),
      executor_(executor),
      engine_(engine),
      precision_(precision),
      operator_kind_(operator_kind),
      fit_(mesh_case, functions) {}

Phases Ours::run() {
    Problem const problem(case_, fit_);
    Clock clock;
    Options options{};
    options.operator_kind = operator_kind_;
    options.executor = executor_;
    options.engine = engine_;
    options.precision = precision_;
    if (engine_ != HM_DIRECT) options.block_width = 4;
    if (engine_ == HM_FAS) options.cycle = HM_CYCLE_IMPROVED;
    options.progress = Clock::told;
    options.progress_user = &clock;

    hm_error error{};
    auto done = [&](hm_status status, const char* call) { require(status, error, call); };
    std::size_t bytes = 0;
    done(hm_analysis_size(&problem.given, &options, &bytes, &error), "hm_analysis_size");
    hm_analysis* analysis = nullptr;
    analysis_bytes_ = static_cast<double>(bytes);
    void* block = workspace_.analysis.give(bytes);
    done(hm_analysis_init(&analysis, block, bytes, &problem.given, &options, &error),
         "hm_analysis_init");

    done(hm_basis_size(analysis, &bytes, &error), "hm_basis_size");
    block = basis_block_.give(bytes);
    done(hm_basis_init(&basis_, block, bytes, analysis, &error), "hm_basis_init");

    hm_plan* plan = nullptr;
    done(hm_plan_size(analysis, &bytes, &error), "hm_plan_size");
    plan_bytes_ = static_cast<double>(bytes);
    block = workspace_.plan.give(bytes);
    Stopwatch planning;
    done(hm_plan_init(&plan, block, bytes, analysis, &error), "hm_plan_init");
    // It also copies the mesh's structure, but most of it is symbolic work that no phase tells of.
    clock.phases.symbolic += planning.seconds();

    done(hm_plan_factor(plan, nullptr, &error), "hm_plan_factor");
    report_.struct_size = sizeof report_;
    done(hm_plan_solve(plan, basis_, &report_, &error), "hm_plan_solve");
    // Refinement is part of the solution, where it brings what the factor lacks.
    if (precision_ == HM_SINGLE) clock.phases.solve += clock.phases.residual;
    return clock.phases;
}

Phases medians(std::vector<Phases> const& runs) {
    auto median_of = [&](double Phases::*phase) {
        std::vector<double> seconds;
        for (Phases const& run : runs) seconds.push_back(run.*phase);
        return median(seconds);
    };
    Phases out;
    for (double Phases::*phase :
         {&Phases::structure, &Phases::ordering, &Phases::symbolic, &Phases::assembly,
          &Phases::factor, &Phases::solve, &Phases::residual})
        out.*phase = median_of(phase);
    return out;
}

}  // namespace bench
