// Views of options. They are apart from the other views so that a program that only moves meshes
// does not link them.
#include "base/vec2.hpp"
#include "limits.hpp"

namespace harmorph {
namespace {

// Checks operator, scheme and engine against the tables of basis/options.hpp, which also contain
// the sentences for what is not available.
Status check_combination(hm_options const& o, hm_study_options const& study,
                         Fault& fault) noexcept {
    if (!has_row(operator_traits, o.operator_kind)) {
        return fault.refuse(Status::unsupported, unknown_operator, plain(o.operator_kind));
    }
    if (!has_row(scheme_traits, study.scheme)) {
        return fault.refuse(Status::unsupported, unknown_scheme, plain(study.scheme));
    }
    if (!has_row(engine_traits, o.engine)) {
        return fault.refuse(Status::unsupported, unknown_engine, plain(o.engine));
    }
    OperatorTraits const& of_operator = operator_traits[o.operator_kind];
    SchemeTraits const& of_scheme = scheme_traits[study.scheme];
    const char* const wrong = !contains(of_operator.schemes, study.scheme)
                                  ? of_operator.other_schemes
                              : !contains(of_operator.engines, o.engine) ? of_operator.other_engines
                              : !contains(of_scheme.engines, o.engine)   ? of_scheme.other_engines
                                                                         : nullptr;
    return wrong == nullptr ? Status::ok : fault.refuse(Status::unsupported, wrong);
}

constexpr Limit<hm_options> option_limits[] = {
    {&hm_options::offset_correction, 0, 1, "options.offset_correction must be 0 or 1, not #"},
    {&hm_options::tolerance, 0, 1 - 0x1p-53,
     "options.tolerance must be at least 0 and below 1, not ~"},
};

// Reads operator, weight, scheme and engine.
Status view_operator(hm_options const& o, hm_study_options const& study, Method& method,
                     Fault& fault) noexcept {
    HARMORPH_TRY(check_combination(o, study, fault));
    bool const in_range = is_finite(o.exponent) && o.exponent <= 4;
    Index const exponent_quarters =
        in_range && o.exponent > 0 ? static_cast<Index>(4 * o.exponent) : 0;
    if (!in_range || (o.exponent > 0 && exponent_quarters != 4 * o.exponent)) {
        return fault.refuse(Status::bad_argument,
                            "options.exponent must be a multiple of 0.25 up to 4, or negative "
                            "for no weight, not ~",
                            {}, {}, o.exponent);
    }
    method.operator_kind = static_cast<Operator>(o.operator_kind);
    method.scheme = static_cast<Scheme>(study.scheme);
    method.engine = static_cast<Engine>(o.engine);
    if (!method.operator_row().has_weight && o.exponent > 0) {
        return fault.refuse(Status::unsupported,
                            "options.exponent must not be positive for HM_LAPLACE, which has no "
                            "weight; HM_WEIGHTED has one");
    }
    if (o.offset_correction != 0 && !method.operator_row().takes_offset_correction) {
        return fault.refuse(
            Status::unsupported,
            "options.offset_correction must be 0 unless the operator is HM_CONFORMAL");
    }
    method.exponent_quarters =
        o.exponent == 0 ? method.operator_row().default_exponent_quarters : exponent_quarters;
    method.offset_correction = o.offset_correction;
    return Status::ok;
}

// Refuses options that the engine does not have, which would otherwise be ignored silently.
Status check_engine(hm_options const& o, hm_study_options const& study, Fault& fault) noexcept {
    const char* wrong = nullptr;
    if (o.engine == HM_DIRECT) {
        if (study.levels != 0)
            wrong = "options.study.levels must be 0 for HM_DIRECT, which has no levels";
        if (study.block_width != 0)
            wrong =
                "options.study.block_width must be 0 unless the engine is HM_MULTIGRID or HM_FAS";
        if (study.max_iterations != 0)
            wrong =
                "options.study.max_iterations must be 0 unless the engine is HM_MULTIGRID or "
                "HM_FAS";
        if (study.history_length != 0)
            wrong =
                "options.study.history_length must be 0 unless the engine is HM_MULTIGRID or "
                "HM_FAS";
    }
    if (o.engine != HM_FAS && study.start != HM_START_COARSEST)
        wrong = "options.study.start must be HM_START_COARSEST unless the engine is HM_FAS";
    if (o.engine != HM_FAS && study.agglomeration != HM_AGGLOMERATE_AUTO)
        wrong = "options.study.agglomeration must be 0 unless the engine is HM_FAS";
    if (o.engine != HM_FAS && study.cycle != HM_CYCLE_PAPER)
        wrong = "options.study.cycle must be HM_CYCLE_PAPER unless the engine is HM_FAS";
    return wrong == nullptr ? Status::ok : fault.refuse(Status::unsupported, wrong);
}

using StudyLimit = Limit<hm_study_options>;
constexpr StudyLimit study_limits[] = {
    {&hm_study_options::levels, 0, Agglomeration::max_levels,
     "options.study.levels must be between 0 and 20, not #"},
    {&hm_study_options::agglomeration, HM_AGGLOMERATE_AUTO, HM_AGGLOMERATE_DIRECTIONAL,
     "options.study.agglomeration is #, but it must be one of the constants HM_AGGLOMERATE_..."},
    {&hm_study_options::max_iterations, 0, infinity,
     "options.study.max_iterations must be at least 0, not #"},
    {&hm_study_options::history_length, 0, infinity,
     "options.study.history_length must be at least 0, not #"},
    {&hm_study_options::start, HM_START_COARSEST, HM_START_ZERO,
     "options.study.start is #, but it must be HM_START_COARSEST or HM_START_ZERO"},
    {&hm_study_options::cycle, HM_CYCLE_PAPER, HM_CYCLE_IMPROVED,
     "options.study.cycle is #, but it must be HM_CYCLE_PAPER or HM_CYCLE_IMPROVED"},
};

Status view_iteration(hm_study_options const& study, Iteration& iteration, Fault& fault) noexcept {
    HARMORPH_TRY(check_limits(study, study_limits, fault));
    if (study.block_width != 0 && !Iteration::has_width(study.block_width)) {
        return fault.refuse(Status::bad_argument,
                            "options.study.block_width must be 0, 4, 8 or 16, not #",
                            plain(study.block_width));
    }
    if (study.history_length > 0 && study.history == nullptr) {
        return fault.refuse(Status::bad_argument,
                            "options.study.history is NULL, but history_length is #",
                            plain(study.history_length));
    }
    iteration.has_improved_cycle = study.cycle == HM_CYCLE_IMPROVED;
    iteration.starts_from_zero = study.start == HM_START_ZERO;
    iteration.merging = {static_cast<Merging>(study.agglomeration), study.levels};
    if (study.block_width != 0) iteration.block_width = study.block_width;
    iteration.max_iterations = study.max_iterations;
    iteration.history = {study.history, static_cast<Size>(study.history_length)};
    return Status::ok;
}

}  // namespace

Status view_options(const hm_options* given, Problem& problem, Fault& fault) noexcept {
    Method& method = problem.method;
    method = Method{};
    problem.iteration = Iteration{};
    problem.executor = Executor{};
    problem.progress = Progress{};
    hm_options o;
    hm_study_options study;
    HARMORPH_TRY(open_options(given, o, "options", "hm_options", fault));
    HARMORPH_TRY(open_options(o.study, study, "options.study", "hm_study_options", fault));
    HARMORPH_TRY(check_limits(o, option_limits, fault));
    HARMORPH_TRY(view_operator(o, study, method, fault));
    HARMORPH_TRY(view_iteration(study, problem.iteration, fault));
    HARMORPH_TRY(check_engine(o, study, fault));
    if (o.tolerance > 0) method.tolerance = o.tolerance;
    problem.iteration.tolerance = method.tolerance;
    problem.progress = {o.progress, o.progress_user};
    HARMORPH_TRY(view_executor(o.executor, problem.executor, fault));
    if (!has_kernel(problem.executor.kernel)) {
        return fault.refuse(Status::unsupported,
                            "executor.kernel is #, a kernel that this processor lacks; "
                            "HM_KERNEL_AUTO always works",
                            plain(static_cast<Index>(problem.executor.kernel)));
    }
    return Status::ok;
}

}  // namespace harmorph
