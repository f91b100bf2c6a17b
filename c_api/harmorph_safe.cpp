// The C interface: makes large movements that stay valid, for which the functions are solved again
// on the way.
#include "apart.hpp"
#include "base/vec2.hpp"
#include "given_list.hpp"
#include "limits.hpp"
#include "morph/quality.hpp"
#include "safe/safe_displacement.hpp"

namespace harmorph {
namespace {

constexpr Index max_others = 64;

constexpr Limit<hm_safe_target> target_limits[] = {
    {&hm_safe_target::reserved, 0, 0, "target.reserved must be 0, not #"},
};

using SafeLimit = Limit<hm_safe_options>;
constexpr SafeLimit safe_limits[] = {
    {&hm_safe_options::skipped_strategies, 0, (2 << HM_STRATEGY_IMPROVED) - 1,
     "options.skipped_strategies is #, but it must be a sum of 1 << HM_STRATEGY_..., that is "
     "between 0 and 31"},
    {&hm_safe_options::improve, 0, 1, "options.improve must be 0 or 1, not #"},
    {&hm_safe_options::improve_work, 0, 10000,
     "options.improve_work must be between 0 and 10000, not #"},
    {&hm_safe_options::reserved, 0, 0, "options.reserved must be 0, not #"},
    {&hm_safe_options::heights, 0, 1, "options.heights must be between 0 and 1, not ~"},
    {&hm_safe_options::min_quality, -infinity, 1, "options.min_quality must be at most 1, not ~"},
    {&hm_safe_options::max_height_change, 1 + 0x1p-52, infinity,
     "options.max_height_change must be 0 or above 1, not ~", SafeLimit::Zero::is_default},
};

Status view_safe_options(const hm_safe_options* given, Span<Basis> others, SafeOptions& options,
                         double*& reached, Fault& fault) noexcept {
    hm_safe_options o;
    HARMORPH_TRY(open_options(given, o, "options", "hm_safe_options", fault));
    HARMORPH_TRY(check_limits(o, safe_limits, fault));
    if (o.n_others < 0 || o.n_others > others.count()) {
        return fault.refuse(Status::bad_argument,
                            others.empty()
                                ? "options.n_others must be 0 with given displacements, not #"
                                : "options.n_others must be between 0 and @, not #",
                            plain(o.n_others), plain(others.count()));
    }
    if (o.n_others > 0 && o.others == nullptr) {
        return fault.refuse(Status::bad_argument, "options.others is NULL, but n_others is #",
                            plain(o.n_others));
    }
    if (o.improve_work != 0) options.improve.max_solutions = o.improve_work;
    if (o.max_resolves != 0) {
        options.max_resolves = max(o.max_resolves, Index{0});
        options.searches = false;
    }
    options.heights = o.heights;
    if (o.min_quality != 0) options.min_quality = max(o.min_quality, 0.0);
    if (o.min_quality < 0) options.fair_quality = options.fine_quality = 0;
    if (o.max_height_change != 0) options.max_height_change = o.max_height_change;
    options.improves = o.improve == 1;
    reached = o.reached;
    options.skipped = static_cast<std::uint32_t>(o.skipped_strategies);
    constexpr std::uint32_t all_that_move = (1u << HM_STRATEGY_IMPROVED) - 1;
    if ((options.skipped & all_that_move) == all_that_move) {
        return fault.refuse(Status::bad_argument,
                            "options.skipped_strategies is #, which leaves no strategy that moves "
                            "the mesh",
                            plain(o.skipped_strategies));
    }
    for (Index i = 0; i < o.n_others; ++i) {
        if (o.others[i] == nullptr) {
            return fault.refuse(Status::bad_argument, "basis # of options.others is NULL",
                                entry_item(i));
        }
        others[i] = Basis::view(static_cast<const void*>(o.others[i]));
    }
    options.others = others.first(o.n_others);
    return Status::ok;
}

hm_safe_report report_of(SafeReport const& safe, Plan const& plan, Points before,
                         Points after) noexcept {
    Index const base = plan.mesh().index_base;
    Quality const quality =
        measure_quality(plan.equations().cells(), after, before, plan.executor());
    hm_safe_report filled = {};
    filled.strategy = static_cast<std::int32_t>(safe.outcome.strategy);
    filled.other = safe.outcome.other;
    filled.steps = safe.outcome.steps;
    filled.resolves = safe.resolves;
    filled.step_fraction = safe.outcome.fraction;
    filled.admissible = safe.limit.step;
    filled.cell = numbered(plan.mesh().number(safe.limit.cell), base);
    filled.point = numbered(limiting_point(plan.equations().cells(), safe.limit), base);
    filled.untangled = safe.untangle.inverted_before;
    filled.iterations = safe.untangle.iterations;
    for (Index k = 0; k < 2; ++k) {
        filled.crossing_points[k] = numbered(safe.crossing.first[k], base);
        filled.crossing_points[2 + k] = numbered(safe.crossing.second[k], base);
    }
    filled.mean_angle_change = safe.first_layer.mean_angle;
    filled.max_angle_change = safe.first_layer.largest_angle;
    filled.angle_point = numbered(safe.first_layer.largest_angle_point, base);
    bool const has_heights =
        safe.first_layer.points > 0;  // a refused movement has none, because nothing moved
    filled.mean_height_ratio = has_heights ? safe.first_layer.mean_ratio : 1;
    filled.min_height_ratio = has_heights ? safe.first_layer.min_ratio : 1;
    filled.max_height_ratio = has_heights ? safe.first_layer.max_ratio : 1;
    filled.min_height_point = numbered(safe.first_layer.min_ratio_point, base);
    filled.max_height_point = numbered(safe.first_layer.max_ratio_point, base);
    filled.heights = safe.heights;
    filled.inverted = quality.inverted;
    filled.min_quality_cell = numbered(quality.min_quality_cell, base);
    filled.min_quality = quality.min_quality;
    filled.mean_quality = quality.mean_quality();
    filled.rotated_offset = safe.outcome.rotated_offset;
    filled.start_quality = safe.start_quality;
    filled.end_point = numbered(safe.end, base);
    filled.end_distance = safe.end_distance;
    filled.solutions = safe.solutions();
    filled.may_improve = safe.may_improve ? 1 : 0;
    filled.n_worst = safe.n_worst;
    for (Index k = 0; k < safe.n_worst; ++k) {
        WorstCell const& worst = safe.worst[k];
        filled.worst[k] = {numbered(worst.cell, base),
                           0,
                           worst.quality,
                           worst.before,
                           worst.centre.x,
                           worst.centre.y};
    }
    return filled;
}

// Checks that the mesh has the coordinates on which the functions were solved, because the curves
// and offsets of the basis belong to these coordinates.
Status check_start(Plan const& plan, Basis const& basis, Fault& fault) noexcept {
    if (basis.header->counts.functions() == 0) return Status::ok;
    if (basis.header->coordinates ==
        coordinates_fingerprint(plan.mesh().points, plan.mesh().n_points))
        return Status::ok;
    return fault.refuse(Status::bad_mesh,
                        "the mesh has moved since the basis was solved; solve the basis again, or "
                        "restore the coordinates");
}

// Refuses a derivative that is one of the other bases: it is cleared before they are read.
Status check_derivative_is_apart(Basis const& derivative, Span<const Basis> others,
                                 Fault& fault) noexcept {
    for (Index i = 0; i < others.count(); ++i) {
        if (derivative.header == nullptr || derivative.header != others[i].header) continue;
        return fault.refuse(Status::bad_argument,
                            "derivative must not be basis # of options.others", entry_item(i));
    }
    return Status::ok;
}

// The arguments and results that both kinds of targets have in common.
struct SafeCall {
    MutablePoints to;
    SafeOptions options;
    SafeReport reached;
    double* reached_movement = nullptr;
    hm_safe_report* report = nullptr;
    bool has_factor = false;

    Status open(const hm_points_out* given, const hm_safe_options* asked, hm_safe_report* wanted,
                Span<Basis> others, CallFault& fault) noexcept {
        report = wanted;
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(view_points(given, "to", to, fault));
        return view_safe_options(asked, others, options, reached_movement, fault);
    }
    // n_functions is the number of functions of the caller's basis.
    Status check_apart(Plan const& plan, const double* move, Index n_functions,
                       Fault& fault) const noexcept {
        Index const n = plan.mesh().n_points;
        Apart arrays, of_mesh;
        arrays.add("target.move", move, 2 * n_functions);
        HARMORPH_TRY(arrays.check("to", to, n, fault));
        of_mesh.add("the mesh", plan.mesh().points, n);
        HARMORPH_TRY(of_mesh.check("options.reached", reached_movement, 2 * n_functions, fault));
        return arrays.check("options.reached", reached_movement, 2 * n_functions, fault);
    }
    Status finish(Plan const& plan, SafeMorph const& safe, Size n_functions,
                  Status status) const noexcept {
        if (failed(status) && status != Status::crossing) return status;
        if (report != nullptr) {
            hm_safe_report filled = report_of(reached, plan, plan.mesh().points, safe.result());
            filled.has_factor = has_factor ? 1 : 0;
            write_struct(filled, report);
        }
        if (failed(status)) return status;
        safe.write(to);
        if (reached_movement != nullptr) {
            std::memcpy(reached_movement, safe.reached.data(), 2 * n_functions * sizeof(double));
        }
        return status;
    }
};

// Opens plan and basis for given displacements. A basis with functions must be solved, and none of
// its functions may be a mode.
template <class Handle, class Object>
Status open_plan_of_given(Handle* handle, Object*& plan, const hm_basis* given, Basis& basis,
                          CallFault& fault) noexcept {
    HARMORPH_TRY(open_basis(given, basis, fault));
    if (basis.header->counts.functions() > 0) HARMORPH_TRY(open_complete(given, basis, fault));
    HARMORPH_TRY(open_plan(handle, plan, fault));
    HARMORPH_TRY(require_given_points(*plan, fault));
    HARMORPH_TRY(plan->check_fit(basis, fault));
    if (basis.header->counts.modes == 0) return Status::ok;
    return fault.refuse(Status::unsupported,
                        "the basis has functions given by table, which move the same points; "
                        "leave target.wall NULL");
}

Status read_target(const hm_safe_target* given, hm_safe_target& target, CallFault& fault) noexcept {
    HARMORPH_TRY(open_struct(given, target, "target", "hm_safe_target", fault));
    HARMORPH_TRY(check_limits(target, target_limits, fault));
    if (target.wall != nullptr || (target.n == 0 && target.points == nullptr)) return Status::ok;
    return fault.refuse(Status::bad_argument,
                        "target.wall is NULL, but target.n is # or target.points is not NULL",
                        plain(target.n));
}

// The working memory of a movement without given displacements.
struct MoveWork {
    Span<Basis> others;  // too large for the stack
    SafeMorph safe;

    void lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept {
        arena.take(others, max_others);
        safe.lay_out(arena, plan, counts);
    }
};

// One call of hm_move_safe.
struct MoveSafe {
    hm_plan* plan;
    const hm_basis* basis;
    hm_safe_target target;  // its fields; zeros where a size query has none
    hm_basis* derivative;
    const hm_points_out* to;
    hm_memory* memory;
    const hm_safe_options* options;
    hm_safe_report* report;

    Status move(CallFault& fault) const noexcept {
        Plan* p = nullptr;
        Basis b, sum;
        SafeCall call;
        MoveWork made;
        // A size query may come before the basis is solved, or without a basis.
        if (!asks(memory)) HARMORPH_TRY(open_solved(basis, b, fault));
        else if (basis != nullptr) b = view_basis(basis, fault);
        HARMORPH_TRY(open_plan(plan, p, fault));
        if (basis != nullptr) HARMORPH_TRY(p->check_fit(b, fault));
        BasisCounts const& counts = basis != nullptr ? b.header->counts : p->basis_counts();
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, *p, counts); }));
        if (derivative == basis)
            return fault.refuse(Status::bad_argument,
                                "options.derivative and basis must be two different bases");
        if (derivative != nullptr) sum = view_basis(derivative, fault);
        HARMORPH_TRY(call.open(to, options, report, made.others, fault));
        HARMORPH_TRY(call.check_apart(*p, target.move, counts.functions(), fault));
        HARMORPH_TRY(check_move(b, target.move, fault));
        call.options.solves_others =
            derivative == nullptr && call.options.others.empty() && call.options.fair_quality > 0;
        // The derivative does not contain what an improvement moves.
        if (derivative != nullptr) call.options.fair_quality = call.options.fine_quality = 0;
        HARMORPH_TRY(check_derivative_is_apart(sum, call.options.others, fault));
        HARMORPH_TRY(check_start(*p, b, fault));
        bool const had_factor = p->is_factored();
        Status const status =
            made.safe.run(*p, b, target.move, call.options, derivative != nullptr ? &sum : nullptr,
                          call.reached, fault);
        call.has_factor = had_factor && call.reached.resolves == 0;
        return call.finish(*p, made.safe, static_cast<Size>(b.header->counts.functions()), status);
    }
    Status displace(CallFault& fault) const noexcept {
        Plan* p = nullptr;
        Basis b;
        PointList list;
        Points displacement;
        SafeCall call;
        HARMORPH_TRY(open_plan_of_given(plan, p, basis, b, fault));
        SafeDisplacement made;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, *p, b); }));
        if (derivative != nullptr) {
            return fault.refuse(
                Status::unsupported,
                "options.derivative must be NULL with given displacements (target.wall)");
        }
        if (target.move != nullptr) HARMORPH_TRY(check_move(b, target.move, fault));
        HARMORPH_TRY(view_given_list(*p, target.n, target.points, list, fault));
        HARMORPH_TRY(check_start(*p, b, fault));
        HARMORPH_TRY(view_points(target.wall, "target.wall", displacement, fault, target.n));
        HARMORPH_TRY(call.open(to, options, report, {}, fault));
        HARMORPH_TRY(call.check_apart(*p, target.move, b.header->counts.functions(), fault));
        call.options.solves_others = true;
        bool const had_factor = p->is_factored();
        Status const status =
            made.run(*p, b, target.move, list, displacement, call.options, call.reached, fault);
        call.has_factor = had_factor && call.reached.resolves == 0;
        return call.finish(*p, made.safe, static_cast<Size>(b.header->counts.functions()), status);
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_move_safe(hm_plan* plan, const hm_basis* basis, const hm_safe_target* target,
                       const hm_points_out* to, hm_memory* memory, const hm_safe_options* options,
                       hm_safe_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        hm_safe_options asked = {};
        MoveSafe call{plan, basis, {}, nullptr, to, memory, options, report};
        if (target != nullptr || !asks(memory))
            HARMORPH_TRY(read_target(target, call.target, fault));
        if (options != nullptr && read_struct(options, asked)) call.derivative = asked.derivative;
        return call.target.wall != nullptr ? call.displace(fault) : call.move(fault);
    });
}

}  // extern "C"
