#include "fixtures/memory.hpp"
#include "ours.hpp"

#include "clock.hpp"

namespace bench {

// The progress callback: a phase lasts from its fraction 0 to its fraction 1.
struct Ours::Clock {
    TimeKind kind;
    Stopwatch watch{};
    ProcessorWatch processor{};
    double begin = 0;
    Phases phases{};

    double seconds() const {
        return kind == TimeKind::wall ? watch.seconds() : processor.seconds();
    }

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
        if (fraction <= 0) self.begin = self.seconds();
        if (fraction >= 1) *seconds += self.seconds() - self.begin;
        return 0;
    }
};

Ours::Ours(Case const& mesh_case, Workspace& workspace, Index functions,
           hm_executor const* executor, Index engine, Index operator_kind)
    : case_(mesh_case),
      workspace_(workspace),
      functions_(functions),
      executor_(executor),
      engine_(engine),
      operator_kind_(operator_kind),
      fit_(mesh_case, functions) {}

struct Ours::Asked {
    Problem problem;
    Options options{};

    explicit Asked(Ours const& ours) : problem(ours.case_, ours.fit_) {
        options.operator_kind = ours.operator_kind_;
        options.executor = ours.executor_;
        options.engine = ours.engine_;
        if (options.engine == HM_FAS) {
            options.block_width = 4;
            options.cycle = HM_CYCLE_IMPROVED;
        }
    }
};

hm_analysis* Ours::analyse(Asked& asked) {
    hm_error error{};
    std::size_t bytes = 0;
    hm_problem const& given = asked.problem.given;
    require(fixtures::analysis_size(&given, &asked.options, &bytes, &error), error, "hm_analysis");
    analysis_bytes_ = static_cast<double>(bytes);
    hm_analysis* analysis = nullptr;
    void* const block = workspace_.analysis.give(bytes);
    require(
        hm_analysis_init(&analysis, fixtures::Memory(block, bytes), &given, &asked.options, &error),
        error, "hm_analysis_init");
    require(fixtures::basis_size(analysis, &bytes, &error), error, "hm_basis");
    basis_bytes_ = static_cast<double>(bytes);
    require(fixtures::plan_size(analysis, &bytes, &error), error, "hm_plan");
    plan_bytes_ = static_cast<double>(bytes);
    return analysis;
}

void Ours::query() {
    Asked asked(*this);
    analyse(asked);
}

Phases Ours::run(TimeKind kind) {
    Asked asked(*this);
    Clock clock{kind};
    asked.options.progress = Clock::told;
    asked.options.progress_user = &clock;

    hm_error error{};
    auto done = [&](hm_status status, const char* call) { require(status, error, call); };
    hm_analysis* const analysis = analyse(asked);
    auto const size = [](double bytes) { return static_cast<std::size_t>(bytes); };
    void* block = basis_block_.give(size(basis_bytes_));
    done(hm_basis_init(&basis_, fixtures::Memory(block, size(basis_bytes_)), analysis, &error),
         "hm_basis_init");

    hm_plan* plan = nullptr;
    block = workspace_.plan.give(size(plan_bytes_));
    double const begin = clock.seconds();
    done(hm_plan_init(&plan, fixtures::Memory(block, size(plan_bytes_)), analysis, &error),
         "hm_plan_init");
    // It also copies the mesh's structure, but most of it is symbolic work that no phase tells of.
    clock.phases.symbolic += clock.seconds() - begin;

    done(hm_plan_factor(plan, nullptr, &error), "hm_plan_factor");
    report_.struct_size = sizeof report_;
    done(hm_plan_solve(plan, basis_, &report_, &error), "hm_plan_solve");
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
