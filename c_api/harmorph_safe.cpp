// The C interface, part 4: morphs that need the plan.
#include <cstring>

#include "fault_text.hpp"
#include "harmorph/morph/quality.hpp"
#include "harmorph/safe/safe_morph.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

constexpr Index most_others = 64;

Index numbered(Index item, Index base) noexcept { return item == none ? none : item + base; }

Status view_safe_options(const hm_safe_options* given, Span<Basis> others, SafeOptions& options, double*& reached,
                         Fault& fault) noexcept {
    hm_safe_options o = {};
    if (given != nullptr && !read_struct(given, o)) {
        return fault.refuse(Status::bad_argument, "safe options: struct_size is not set");
    }
    if (given != nullptr && asks_for_more(given)) {
        return fault.refuse(Status::unsupported, "safe options: fields are set that this version of the library does not know");
    }
    if (o.skipped_rungs < 0 || o.skipped_rungs >= 2 << HM_RUNG_UNTANGLED || o.reserved != 0) {
        return fault.refuse(Status::bad_argument, "safe options: skipped_rungs is #, which names rungs there are not, or "
                            "reserved is not 0", Counts::from_zero, o.skipped_rungs);
    }
    if (o.n_others < 0 || o.n_others > others.count() || (o.n_others > 0 && o.others == nullptr)) {
        return fault.refuse(Status::bad_argument, "safe options: others is NULL, or n_others is #, not 0 .. @",
                            Counts::from_zero, o.n_others, others.count());
    }
    if (o.max_resolves != 0) options.most_resolves = larger(o.max_resolves, Index{0});
    if (!(o.heights >= 0 && o.heights <= 1)) {
        return fault.refuse(Status::bad_argument, "safe options: heights must be between 0 and 1, not ~", Counts::from_zero,
                            none, none, o.heights);
    }
    options.heights = o.heights;
    reached = o.reached;
    options.skipped = static_cast<std::uint32_t>(o.skipped_rungs);
    for (Index i = 0; i < o.n_others; ++i) {
        if (o.others[i] == nullptr) return fault.refuse(Status::bad_argument, "basis # (from 0) of others is NULL", Counts::from_zero, i);
        others[i] = Basis::view(static_cast<const void*>(o.others[i]));
    }
    options.others = others.first(o.n_others);
    return Status::ok;
}

Status check_target(Basis const& basis, const double* move, Fault& fault) noexcept {
    if (move == nullptr) return fault.refuse(Status::bad_argument, "move is NULL");
    for (Index k = 0; k < 2 * basis.n_functions(); ++k) {
        if (!is_finite(move[k])) {
            return fault.refuse(Status::bad_argument, "the movement of function # (from 0) is not finite", Counts::from_zero, k / 2);
        }
    }
    return Status::ok;
}

hm_safe_report report_of(SafeReport const& safe, Plan const& plan, Points before, Points after) noexcept {
    Index const base = plan.mesh.index_base;
    Quality const quality = measure_quality(plan.equations.cells, after, before, plan.executor);
    hm_safe_report filled = {};
    filled.rung = static_cast<std::int32_t>(safe.rung);
    filled.other = safe.other;
    filled.steps = safe.steps;
    filled.resolves = safe.resolves;
    filled.step_fraction = safe.fraction;
    filled.admissible = safe.limit.step;
    filled.cell = numbered(safe.limit.cell, base);
    filled.point = numbered(limiting_point(plan.equations.cells, safe.limit), base);
    filled.untangled = safe.untangle.inverted_before;
    filled.iterations = safe.untangle.iterations;
    for (Index k = 0; k < 2; ++k) {
        filled.crossing_points[k] = numbered(safe.crossing.first[k], base);
        filled.crossing_points[2 + k] = numbered(safe.crossing.second[k], base);
    }
    filled.mean_angle_change = safe.first_layer.mean_angle;
    filled.max_angle_change = safe.first_layer.largest_angle;
    filled.angle_point = numbered(safe.first_layer.largest_angle_point, base);
    filled.mean_height_ratio = safe.first_layer.mean_ratio;
    filled.min_height_ratio = safe.first_layer.min_ratio;
    filled.max_height_ratio = safe.first_layer.max_ratio;
    filled.min_height_point = numbered(safe.first_layer.min_ratio_point, base);
    filled.max_height_point = numbered(safe.first_layer.max_ratio_point, base);
    filled.heights = safe.heights;
    filled.inverted = quality.inverted;
    filled.min_quality_cell = numbered(quality.min_quality_cell, base);
    filled.min_quality = quality.min_quality;
    filled.mean_quality = quality.mean_quality();
    return filled;
}

void lay_out(Arena& arena, Plan const& plan, Span<SafeMorph>& place, SafeMorph& safe) noexcept {
    arena.take(place, 1);
    safe.lay_out(arena, plan);
}

Status run(Plan& plan, Basis const& basis, const double* move, const hm_points_out* given_to, const Basis* derivative, void* work,
           Size bytes, const hm_safe_options* given, hm_safe_report* report, Fault& fault) noexcept {
    MutablePoints to;
    HARMORPH_TRY(check_target(basis, move, fault));
    HARMORPH_TRY(view_points(given_to, "to", to, fault));
    Basis others[most_others];
    SafeOptions options;
    double* reached_movement = nullptr;
    HARMORPH_TRY(view_safe_options(given, {others, most_others}, options, reached_movement, fault));
    Arena arena(work, bytes);
    Span<SafeMorph> place;
    SafeMorph safe;
    lay_out(arena, plan, place, safe);
    HARMORPH_TRY(arena.verify(bytes, fault));
    SafeReport reached;
    Status const status = safe.run(plan, basis, move, options, derivative, reached, fault);
    if (failed(status) && status != Status::crossing) return status;
    if (report != nullptr) write_struct(report_of(reached, plan, plan.mesh.points, safe.result()), report);
    if (failed(status)) return status;
    safe.write(to);
    if (reached_movement != nullptr) {
        std::memcpy(reached_movement, safe.reached.data(), static_cast<Size>(safe.reached.count()) * sizeof(double));
    }
    return status;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_morph_safe_size(const hm_plan* plan, size_t* bytes, hm_error* err) {
    Fault fault;
    if (plan == nullptr || bytes == nullptr) {
        fault.refuse(Status::bad_argument, "plan or bytes is NULL");
        return tell(err, fault);
    }
    Arena counting;
    Span<SafeMorph> place;
    SafeMorph safe;
    lay_out(counting, *reinterpret_cast<const Plan*>(plan), place, safe);
    if (!failed(counting.verify(0, fault))) *bytes = counting.bytes();
    return tell(err, fault);
}

hm_status hm_morph_safe(hm_plan* plan, const hm_basis* basis, const double* move, const hm_points_out* to,
                        hm_basis* derivative, void* work, size_t bytes, const hm_safe_options* options,
                        hm_safe_report* report, hm_error* err) {
    Fault fault;
    if (plan == nullptr || basis == nullptr || work == nullptr || static_cast<const hm_basis*>(derivative) == basis) {
        fault.refuse(Status::bad_argument, "plan, basis or work is NULL, or derivative is the basis itself");
        return tell(err, fault);
    }
    if (report != nullptr && failed(check_report(report, fault))) return tell(err, fault);
    Plan& p = *reinterpret_cast<Plan*>(plan);
    Basis const b = Basis::view(static_cast<const void*>(basis));
    Basis const sum = derivative != nullptr ? Basis::view(static_cast<void*>(derivative)) : Basis{};
    if (b.header->solved != 1) {
        fault.refuse(Status::bad_basis, "the basis has not been solved");
    } else {
        run(p, b, move, to, derivative != nullptr ? &sum : nullptr, work, bytes, options, report, fault);
    }
    return tell(err, fault, {p.mesh.index_base, 0});
}

}  // extern "C"
