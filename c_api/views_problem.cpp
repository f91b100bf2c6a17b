// What a problem consists of beside the mesh, and the options of a fit. Apart from the other views,
// so that a program which only moves meshes does not link them.
#include "base/range.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

// The tables of basis/options.hpp say what goes together; the sentence says what would.
Status check_combination(hm_options const& o, hm_study_options const& study,
                         Fault& fault) noexcept {
    if (!has_row(operator_traits, o.operator_kind)) {
        return fault.refuse(Status::unsupported, "options.operator_kind is #, which is unknown",
                            plain(o.operator_kind));
    }
    if (!has_row(scheme_traits, study.scheme)) {
        return fault.refuse(Status::unsupported, "study options: scheme is #, which is unknown",
                            plain(study.scheme));
    }
    if (!has_row(engine_traits, o.engine)) {
        return fault.refuse(Status::unsupported, "options.engine is #, which is unknown",
                            plain(o.engine));
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

// Operator, weight, scheme and engine.
Status view_operator(hm_options const& o, hm_study_options const& study, Method& method,
                     Fault& fault) noexcept {
    HARMORPH_TRY(check_combination(o, study, fault));
    if (o.exponent_quarters < HM_NO_WEIGHT || o.exponent_quarters > 16) {
        return fault.refuse(Status::bad_argument,
                            "options.exponent_quarters must be between -1 and 16, not #",
                            plain(o.exponent_quarters));
    }
    method.operator_kind = static_cast<Operator>(o.operator_kind);
    method.scheme = static_cast<Scheme>(study.scheme);
    method.engine = static_cast<Engine>(o.engine);
    if (!method.operator_row().has_weight && o.exponent_quarters > 0) {
        return fault.refuse(Status::unsupported,
                            "the Laplace operator has no weight; HM_WEIGHTED has one");
    }
    if (o.offset_correction < 0 || o.offset_correction > 1) {
        return fault.refuse(Status::bad_argument, "options.offset_correction must be 0 or 1, not #",
                            plain(o.offset_correction));
    }
    if (o.offset_correction != 0 && !method.operator_row().takes_offset_correction) {
        return fault.refuse(Status::unsupported,
                            "the offset correction goes with the conformal operator only");
    }
    method.quarters = o.exponent_quarters == 0 ? method.operator_row().usual_quarters
                                               : max(o.exponent_quarters, Index{0});
    method.offset_correction = o.offset_correction;
    return Status::ok;
}

}  // namespace

namespace {

// Options that the engine does not have would be left out silently.
Status check_engine(hm_options const& o, hm_study_options const& study, Fault& fault) noexcept {
    const char* wrong = nullptr;
    if (o.engine == HM_DIRECT) {
        if (study.levels != 0)
            wrong = "study options: levels: the direct engine has no levels; multigrid and fas do";
        if (study.agglomeration != HM_AGGLOMERATE_AUTO) {
            wrong =
                "study options: agglomeration: the direct engine merges no cells; multigrid and "
                "fas do";
        }
        if (study.block_width != 0)
            wrong = "study options: block_width goes with the engines multigrid and fas only";
        if (study.max_iterations != 0)
            wrong = "study options: max_iterations goes with the engines multigrid and fas only";
        if (study.history_length != 0)
            wrong = "study options: history goes with the engines multigrid and fas only";
    } else if (o.precision != HM_DOUBLE) {
        wrong = "options.precision: only the direct engine has a factor to store in single";
    }
    if (o.engine != HM_FAS && study.start != HM_START_COARSEST)
        wrong = "study options: start goes with the engine fas only";
    return wrong == nullptr ? Status::ok : fault.refuse(Status::unsupported, wrong);
}

Status view_iteration(hm_study_options const& study, Iteration& iteration, Fault& fault) noexcept {
    if (study.levels < 0 || study.levels > Agglomeration::most_levels) {
        return fault.refuse(Status::bad_argument,
                            "study options: levels must be between 0 and 20, not #",
                            plain(study.levels));
    }
    if (study.agglomeration < HM_AGGLOMERATE_AUTO ||
        study.agglomeration > HM_AGGLOMERATE_DIRECTIONAL) {
        return fault.refuse(Status::bad_argument,
                            "study options: agglomeration is #, which is unknown",
                            plain(study.agglomeration));
    }
    if (study.block_width != 0 && !Iteration::has_width(study.block_width)) {
        return fault.refuse(Status::bad_argument,
                            "study options: block_width must be 0, 4, 8 or 16, not #",
                            plain(study.block_width));
    }
    if (study.max_iterations < 0 || study.history_length < 0 ||
        (study.history_length > 0 && study.history == nullptr)) {
        return fault.refuse(
            Status::bad_argument,
            "study options: max_iterations or history_length is negative, or history is NULL");
    }
    if (study.start < HM_START_COARSEST || study.start > HM_START_ZERO) {
        return fault.refuse(Status::bad_argument, "study options: start is #, which is unknown",
                            plain(study.start));
    }
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
    hm_options o = {};
    if (given != nullptr && !read_struct(given, o)) {
        return fault.refuse(Status::bad_argument, "options.struct_size is wrong");
    }
    if (given != nullptr && asks_for_more(given)) {
        return fault.refuse(
            Status::unsupported,
            "options: fields are set that this version of the library does not know");
    }
    hm_study_options study = {};
    if (o.study != nullptr && !read_struct(o.study, study)) {
        return fault.refuse(Status::bad_argument, "study options: struct_size is wrong");
    }
    if (o.study != nullptr && asks_for_more(o.study)) {
        return fault.refuse(
            Status::unsupported,
            "study options: fields are set that this version of the library does not know");
    }
    HARMORPH_TRY(view_operator(o, study, method, fault));
    HARMORPH_TRY(view_iteration(study, problem.iteration, fault));
    if (!is_finite(o.tolerance) || o.tolerance < 0 || o.tolerance >= 1) {
        return fault.refuse(Status::bad_argument,
                            "options.tolerance must be at least 0 and below 1, not ~", {}, {},
                            o.tolerance);
    }
    if (o.kernel < HM_KERNEL_AUTO || o.kernel > HM_KERNEL_NEON ||
        !has_kernel(static_cast<Kernel>(o.kernel))) {
        return fault.refuse(Status::unsupported,
                            "options.kernel is #, which this processor does not have",
                            plain(o.kernel));
    }
    method.kernel = static_cast<Kernel>(o.kernel);
    if (o.precision < HM_DOUBLE || o.precision > HM_SINGLE) {
        return fault.refuse(Status::unsupported, "options.precision # is unknown",
                            plain(o.precision));
    }
    method.precision = static_cast<Precision>(o.precision);
    HARMORPH_TRY(check_engine(o, study, fault));
    if (o.tolerance > 0) method.tolerance = o.tolerance;
    problem.iteration.tolerance = method.tolerance;
    problem.progress = {o.progress, o.progress_user};
    return view_executor(o.executor, problem.executor, fault);
}

Status view_fit_options(const hm_fit_options* given, FitOptions& options,
                        CallFault& fault) noexcept {
    options = FitOptions{};
    if (given == nullptr) return Status::ok;
    hm_fit_options o;
    if (!read_struct(given, o))
        return fault.refuse(Status::bad_argument, "fit options: struct_size is wrong");
    if (o.closed < HM_CLOSED_AUTO || o.closed > HM_PERIODIC) {
        return fault.refuse(Status::bad_argument, "fit options: closed is #, which is unknown",
                            plain(o.closed));
    }
    if (o.index_base != 0 && o.index_base != 1) {
        return fault.refuse(Status::bad_argument, "fit options: index_base must be 0 or 1, not #",
                            plain(o.index_base));
    }
    fault.bases.curves = o.index_base;
    if (o.degree != 0) options.degree = o.degree;
    if (o.n_control != 0) options.n_control = o.n_control;
    options.closure = static_cast<Closure>(o.closed);
    return Status::ok;
}

Status view_curves(const hm_curves* given, CurvesView& view, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"curves", given}}, fault));
    if (!read_struct(given, view.set))
        return fault.refuse(Status::bad_argument, "curves.struct_size is wrong");
    hm_curves const& set = view.set;
    fault.bases.curves = set.index_base;
    if (set.index_base != 0 && set.index_base != 1) {
        return fault.refuse(Status::bad_argument, "curves.index_base must be 0 or 1");
    }
    if (set.control == nullptr || set.curve == nullptr) {
        return fault.refuse(Status::bad_argument, "curves.control or curves.curve is NULL");
    }
    constexpr Index most = Index{1} << 24;
    if (set.n_control < 2 || set.n_control > most) {
        return fault.refuse(Status::bad_curve, "curves.n_control must be between 2 and 2^24, not #",
                            plain(set.n_control));
    }
    if (set.n_curves < 1 || set.n_curves > most) {
        return fault.refuse(Status::bad_curve, "curves.n_curves must be between 1 and 2^24, not #",
                            plain(set.n_curves));
    }
    return Status::ok;
}

Status CurvesView::curve(Index number, Curve& out, Fault& fault) const noexcept {
    hm_curve c;
    if (!read_struct(set.curve, c) || !read_struct(element(set.curve, number), c)) {
        return fault.refuse(Status::bad_argument, "struct_size of curve # is wrong",
                            curve_item(number));
    }
    if (c.knots == nullptr) {
        return fault.refuse(Status::bad_argument, "knots of curve # is NULL", curve_item(number));
    }
    out = Curve{};
    out.degree = c.degree;
    out.n_indices = c.n_indices;
    out.index_base = set.index_base;
    out.n_control = set.n_control;
    out.indices = c.indices;
    out.knots = c.knots;
    out.control = set.control;
    out.weights = set.weights;
    return Status::ok;
}

namespace {

// Fields of another kind than the condition's would be left out silently.
Status check_fields(hm_condition const& c, Index number, Fault& fault) noexcept {
    unsigned const fields = condition_traits[c.kind].fields;
    auto const has_not = [&](ConditionField field) { return !contains(fields, field); };
    const char* wrong = nullptr;
    if ((c.first_curve != 0 && has_not(ConditionField::curves)) ||
        (c.n_curves != 0 && has_not(ConditionField::curves) && has_not(ConditionField::along))) {
        wrong =
            "condition # has first_curve or n_curves, which are of HM_ON_CURVE only, but "
            "its kind is @";
    } else if (c.along != nullptr && has_not(ConditionField::along)) {
        wrong =
            "condition # has curves along which to slide, which are of HM_SLIP only, but "
            "its kind is @";
    } else if (c.body != 0 && has_not(ConditionField::body)) {
        wrong = "condition # has body, which is of HM_RIGID only, but its kind is @";
    } else if (!(c.x == 0 && c.y == 0) && has_not(ConditionField::centre)) {
        wrong =
            "condition # has x or y, which are of HM_RIGID and HM_ROTATION_PAIR only, but "
            "its kind is @";
    } else if (c.piece < 0 || c.piece > 1 || c.reserved != 0) {
        wrong =
            "condition # has a piece that is neither 0 nor 1, or reserved is not 0; its "
            "kind is @";
    } else if (c.piece != 0 && has_not(ConditionField::piece)) {
        wrong =
            "condition # chooses a piece, which periodic pairs and interfaces cannot; its "
            "kind is @";
    } else if (c.piece == 0 && !(c.near_x == 0 && c.near_y == 0)) {
        wrong = "condition # has near_x or near_y, but chooses no piece; its kind is @";
    } else if (c.partner != 0 && has_not(ConditionField::partner)) {
        wrong = "condition # has partner, which is of pairs and interfaces only, but its kind is @";
    }
    if (wrong != nullptr)
        return fault.refuse(Status::bad_condition, wrong, condition_item(number), plain(c.kind));
    if (has_not(ConditionField::along)) return Status::ok;
    if (c.along == nullptr && c.n_curves != 0) {
        return fault.refuse(Status::bad_condition,
                            "condition # slides along @ curves, but its `along` is NULL: "
                            "a basis does not keep them",
                            condition_item(number), plain(c.n_curves));
    }
    hm_curves set;
    bool const fits = c.along == nullptr || (read_struct(c.along, set) &&
                                             set.n_curves == c.n_curves && set.n_curves >= 1);
    if (fits) return Status::ok;
    return fault.refuse(
        Status::bad_condition,
        "condition # has n_curves @, but that is not the number of curves in its `along`",
        condition_item(number), plain(c.n_curves));
}

}  // namespace

Status view_condition(const hm_condition* array, Index number, Condition& out,
                      Fault& fault) noexcept {
    hm_condition c;
    if (!read_struct(array, c) || !read_struct(element(array, number), c)) {
        return fault.refuse(Status::bad_argument, "struct_size of condition # is wrong",
                            condition_item(number));
    }
    if (!has_row(condition_traits, c.kind)) {
        return fault.refuse(Status::bad_argument, "condition # has the unknown kind @",
                            condition_item(number), plain(c.kind));
    }
    constexpr Index most_bodies = Index{1} << 20;
    if (c.kind == HM_RIGID && (c.body < 0 || c.body >= most_bodies)) {
        return fault.refuse(Status::bad_condition,
                            "condition # names rigid body @, which there cannot be",
                            condition_item(number), body_item(c.body));
    }
    HARMORPH_TRY(check_fields(c, number, fault));
    if (!is_coordinate({c.near_x, c.near_y})) {
        return fault.refuse(Status::bad_condition,
                            "near_x or near_y of condition # is not finite, or larger than 1e100",
                            condition_item(number));
    }
    out = {c.marker,
           static_cast<ConditionKind>(c.kind),
           c.first_curve,
           c.n_curves,
           c.body,
           c.partner,
           {c.x, c.y},
           c.piece,
           0,
           {c.near_x, c.near_y}};
    return Status::ok;
}

}  // namespace harmorph
