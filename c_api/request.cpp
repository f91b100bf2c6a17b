#include "limits.hpp"
#include "request.hpp"

namespace harmorph {

namespace {

constexpr Limit<hm_problem> problem_limits[] = {
    {&hm_problem::n_conditions, 0, infinity, "problem.n_conditions must be at least 0, not #"},
    {&hm_problem::n_known, 0, infinity, "problem.n_known must be at least 0, not #"},
    {&hm_problem::n_fluxes, 0, 0.5 * Mesh::max_points,
     "problem.n_fluxes must be between 0 and 2^29, not #"},
    {&hm_problem::max_curve_distance, 0, largest_coordinate,
     "problem.max_curve_distance must be between 0 and 1e100, not ~"},
};

}  // namespace

Status Request::read(const hm_problem* given, const hm_options* options,
                     CallFault& fault) noexcept {
    hm_problem p;
    HARMORPH_TRY(open_struct(given, p, "problem", "hm_problem", fault));
    HARMORPH_TRY(view_mesh(p.mesh, problem.mesh, fault));
    return read_rest(p, options, fault);
}

Status Request::read_without_mesh(const hm_problem* given, const hm_options* options,
                                  CallFault& fault) noexcept {
    hm_problem p;
    HARMORPH_TRY(open_struct(given, p, "problem", "hm_problem", fault));
    return read_rest(p, options, fault);
}

Status Request::read_rest(hm_problem const& p, const hm_options* options,
                          CallFault& fault) noexcept {
    HARMORPH_TRY(check_limits(p, problem_limits, fault));
    HARMORPH_TRY(view_options(options, problem, fault));
    if (p.curves != nullptr) {
        HARMORPH_TRY(view_curves(p.curves, curves, fault));
        n_curves = curves.count();
    }
    HARMORPH_TRY(read_fluxes(p, fault));
    HARMORPH_TRY(read_conditions(p, fault));
    if (p.n_known > 0 && (!p.known_points || !p.known_curves || !p.known_u)) {
        return fault.refuse(
            Status::bad_argument,
            "problem.known_points, known_curves or known_u is NULL, but problem.n_known is #",
            plain(p.n_known));
    }
    if (p.max_curve_distance > 0) problem.max_curve_distance = p.max_curve_distance;
    Size const n = static_cast<Size>(p.n_known);
    problem.given = {
        problem.mesh.index_base, {p.known_points, n}, {p.known_curves, n}, {p.known_u, n}};
    return Status::ok;
}

Status Request::read_fluxes(hm_problem const& p, Fault& fault) noexcept {
    if (p.n_fluxes == 0) return Status::ok;
    if (p.flux_points == nullptr || p.fluxes == nullptr) {
        return fault.refuse(Status::bad_argument,
                            "problem.flux_points or fluxes is NULL, but problem.n_fluxes is #",
                            plain(p.n_fluxes));
    }
    if (n_curves == 0) {
        return fault.refuse(Status::bad_condition,
                            "problem.n_fluxes is #, but there are no control points, which fluxes "
                            "belong to",
                            plain(p.n_fluxes));
    }
    Size const n = static_cast<Size>(p.n_fluxes);
    problem.fluxes = {problem.mesh.index_base,
                      {p.flux_points, 2 * n},
                      {p.fluxes, n * static_cast<Size>(n_control())},
                      n_control()};
    return Status::ok;
}

const hm_curves* Request::along_of(Index number) const noexcept {
    hm_condition given;
    return read_struct(element(condition, number), given) ? given.along : nullptr;
}

// Copies curves and conditions. Conditions with the same set `along` share the copies of its
// curves.
Status Request::copy_to(Span<Curve> to_curves, Span<Curve> to_slip, Span<Condition> to_conditions,
                        CallFault& fault) const noexcept {
    for (Index i = 0; i < n_curves; ++i) HARMORPH_TRY(curves.curve(i, to_curves[i], fault));
    Index n_slip = 0;
    for (Index i = 0; i < n_conditions; ++i) {
        view_condition(condition, i, to_conditions[i],
                       fault);  // cannot fail: read() has checked it
        const hm_curves* const along = along_of(i);
        if (along == nullptr) continue;
        CurvesView set;
        auto const bases = fault.bases;
        HARMORPH_TRY(view_curves(along, set, fault));
        fault.bases = bases;
        to_conditions[i].first_curve = n_slip;
        for (Index k = 0; k < set.count(); ++k)
            HARMORPH_TRY(set.curve(k, to_slip[n_slip++], fault));
        Index same = 0;
        while (along_of(same) != along) ++same;
        to_conditions[i].first_curve = to_conditions[same].first_curve;
    }
    return Status::ok;
}

Status Request::check_rotation(Fault& fault) const noexcept {
    const char* wrong = nullptr;
    if (problem.method.scheme != Scheme::compact)
        wrong = "HM_ROTATION_PAIR needs the compact scheme (HM_COMPACT)";
    if (problem.method.engine != Engine::direct)
        wrong = "HM_ROTATION_PAIR needs the direct engine (HM_DIRECT)";
    if (problem.fluxes.count() > 0)
        wrong = "HM_ROTATION_PAIR cannot be combined with fluxes (hm_problem.fluxes)";
    if (problem.demands.slip)
        wrong =
            "HM_ROTATION_PAIR cannot be combined with slip (HM_SLIP), but with fixed and free "
            "boundaries";
    if (problem.demands.translation)
        wrong = "HM_ROTATION_PAIR cannot be combined with HM_PERIODIC_PAIR";
    return wrong == nullptr ? Status::ok : fault.refuse(Status::unsupported, wrong);
}

// Reads the conditions. If no wall moves, there is nothing to solve, and the conditions are
// ignored.
Status Request::read_conditions(hm_problem const& p, Fault& fault) noexcept {
    if (p.n_conditions > 0 && p.conditions == nullptr) {
        return fault.refuse(Status::bad_argument,
                            "problem.conditions is NULL, but problem.n_conditions is #",
                            plain(p.n_conditions));
    }
    for (Index i = 0; i < p.n_conditions; ++i) {
        Condition added;
        HARMORPH_TRY(view_condition(p.conditions, i, added, fault));
        problem.demands.add(added);
    }
    if (!problem.demands.any_wall(n_curves)) return Status::ok;
    if (p.n_conditions == 0) {
        return fault.refuse(
            Status::bad_condition,
            "the problem has curves, but no condition that puts a marker on a curve");
    }
    condition = p.conditions;
    n_conditions = p.n_conditions;
    SchemeTraits const& scheme = problem.method.scheme_row();
    if (problem.demands.slip && !scheme.takes_slip) {
        return fault.refuse(
            Status::unsupported,
            problem.method.bounded()
                ? "the bounded scheme (HM_BOUNDED) cannot be combined with slip (HM_SLIP)"
                : "schemes with nodal gradients cannot be combined with slip (HM_SLIP); use "
                  "HM_COMPACT");
    }
    if (problem.demands.given && !scheme.takes_given) {
        return fault.refuse(Status::unsupported,
                            "schemes with nodal gradients cannot be combined with given "
                            "displacements (HM_GIVEN); use HM_COMPACT");
    }
    if (problem.demands.slip && !problem.method.traits().takes_slip) {
        return fault.refuse(Status::unsupported,
                            "slip (HM_SLIP) needs the engine HM_DIRECT or HM_MULTIGRID");
    }
    if (problem.demands.slip && problem.method.conformal() &&
        problem.method.engine != Engine::direct) {
        return fault.refuse(Status::unsupported,
                            "the conformal operator with slip (HM_SLIP) needs the direct engine "
                            "(HM_DIRECT)");
    }
    if (problem.demands.rotation) HARMORPH_TRY(check_rotation(fault));
    if (!problem.demands.free || problem.method.operator_row().takes_free) return Status::ok;
    return fault.refuse(Status::unsupported,
                        "the conformal operator cannot be combined with free boundaries (HM_FREE); "
                        "use slip (HM_SLIP) or another operator");
}

}  // namespace harmorph
