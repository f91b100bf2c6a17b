#include "safe/safe_morph.hpp"

#include "base/vec2.hpp"
#include "basis/basis_measures.hpp"
#include "morph/weighted_sum.hpp"
#include "safe/basis_match.hpp"
#include "safe/safe_work.hpp"
#include "safe/target.hpp"

namespace harmorph {

void SafeMorph::lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept {
    Index const n = plan.mesh().n_points, n_functions = counts.functions();
    mesh.lay_out(arena, plan, counts);
    arena.take(best_x, n);
    arena.take(best_y, n);
    arena.take(reached, 2 * Offset{n_functions});
    arena.take(weight, n_functions);
    arena.take(block, Basis::bytes(counts));
    first_layer.lay_out(arena, plan.mesh(), static_cast<Size>(plan.walls().count));
    wall_heights.lay_out(arena, plan.mesh(), static_cast<Size>(plan.walls().count));
    arena.take(kinds, n);
    mobility.lay_out(arena, plan);
    auto const shared = arena.mark();
    untangling.lay_out(arena, plan.region_counts());
    arena.release(shared);
    improvement.lay_out(arena, plan);
}

Status SafeMorph::run(Plan& plan, Basis const& basis, const Real* move, SafeOptions const& options,
                      const Basis* derivative, SafeReport& report, Fault& fault) noexcept {
    Work work{plan, basis, options, derivative, report, fault, {}};
    HARMORPH_TRY(plan.check_fit(basis, fault));
    if (!basis.header->counts.complete() ||
        (derivative != nullptr && !derivative->header->counts.complete())) {
        return fault.refuse(
            Status::bad_basis,
            "a basis with a share of the functions cannot move the mesh: all functions are needed");
    }
    if (derivative != nullptr) HARMORPH_TRY(check_derivative(plan, basis, *derivative, fault));
    for (Basis const& other : options.others) HARMORPH_TRY(check_other(basis, other, fault));
    mesh.init(plan, basis, move);
    copy(best_x, Span<const Real>(mesh.x));
    copy(best_y, Span<const Real>(mesh.y));
    fill(reached, 0.0);
    report.limit = look_ahead(work, basis, 1);
    find_end_that_leaves(work);
    Target const target{work.cells(),       basis.faces(), mesh.ends,
                        plan.mesh().points, mesh.ahead(),  &plan.walls()};
    for (Index k = 0; k < mesh.ends.count(); ++k) {
        if (mesh.ends[k] == KnownEnd::on_line) mesh.to_ahead().set(k, plan.mesh().points[k]);
    }
    HARMORPH_TRY(check_target(target, report.crossing, fault));
    HARMORPH_TRY(check_tear(basis, move, plan.mesh().points, Status::crossing, fault));

    Quality const start = measure_quality(work.cells(), mesh.now(), {}, work.executor());
    report.start_quality = start.min_quality;
    report.start_mean = start.mean_quality();
    report.outcome.min_quality = report.start_quality;
    first_layer.find(plan.mesh(), plan.mesh().points, mesh.representative,
                     plan.walls_at(plan.mesh().points).chosen());
    Method const method = plan.equations().method();
    Status status = climb(work);
    if (!failed(status) && !work.arrives(work.best()) && options.searches)
        status = search_farthest(work);
    plan.change_operator(method.operator_kind, method.exponent_quarters);
    if (work.factored_again)
        plan.forget_factor();  // the factor is that of another mesh or operator
    HARMORPH_TRY(status);
    return finish(work);
}

// Tries one strategy after another until the mesh is good.
Status SafeMorph::climb(Work& work) noexcept {
    SafeOptions const& options = work.options;
    if (options.tries(Strategy::linear)) single_step(work, work.basis, Strategy::linear, none);
    for (Index i = 0; i < options.others.count() && options.tries(Strategy::other); ++i) {
        if (work.is_fair(work.best())) break;
        Basis const& other = options.others[i];
        if (work.derivative == nullptr || other.kind() == work.basis.kind())
            single_step(work, other, Strategy::other, i);
    }
    if (!work.is_fair(work.best()) && options.solves_others && options.tries(Strategy::other))
        HARMORPH_TRY(other_operators(work));
    if (!work.is_good(work.best())) HARMORPH_TRY(several_steps(work));
    improve_result(work);
    return Status::ok;
}

void SafeMorph::improve_result(Work& work) noexcept {
    SafeOptions const& options = work.options;
    if (work.searches) return;
    bool const is_improved = work.best().strategy == Strategy::improved && !work.report.may_improve;
    if (!work.is_fine(work.best()) && options.tries(Strategy::improved) && !options.improves &&
        !is_improved)
        improve(work, result());
}

// Makes the movement in several steps, on straight ways where bodies that turn do not arrive.
Status SafeMorph::several_steps(Work& work) noexcept {
    bool const may_turn_back = work.derivative == nullptr;
    HARMORPH_TRY(substeps(work));
    if (!work.arrives(work.best()) && may_turn_back && mesh.path.is_bent()) {
        mesh.path.straighten(work.basis);
        mesh.carried.init(work.basis, mesh.path, work.mesh().points);
        HARMORPH_TRY(substeps(work));
    }
    if (!work.arrives(work.best()) && work.options.tries(Strategy::linear))
        longest_linear_step(work);
    return Status::ok;
}

// Tries parts of a movement that cannot be completed, by bisection, with all strategies.
Status SafeMorph::search_farthest(Work& work) noexcept {
    constexpr Real enough = 0.02;
    Index const first = work.report.solutions();
    Real refused = 1;
    while (refused - work.best().fraction > enough &&
           work.report.solutions() - first < SafeOptions::max_in_search &&
           work.solutions_left() > 0) {
        work.aim = 0.5 * (work.best().fraction + refused);
        work.resolves_before = work.report.resolves;
        work.searches = true;
        HARMORPH_TRY(climb(work));
        if (!work.arrives(work.best())) refused = work.aim;
    }
    work.searches = false;
    work.aim = work.best().fraction;
    improve_result(work);
    work.aim = 1;
    return Status::ok;
}

void SafeMorph::begin(Work& work) noexcept {
    mesh.begin(work.plan);
    work.attempt = {};
    work.derivative_of_best = false;
    if (work.derivative == nullptr) return;
    work.derivative->unseal();
    fill(work.derivative->value, 0.0);
}

AdmissibleStep SafeMorph::look_ahead(Work& work, Basis const& by, Real to) noexcept {
    return mesh.look_ahead(work.plan, work.basis, by, to);
}

void SafeMorph::single_step(Work& work, Basis const& by, Strategy strategy, Index other) noexcept {
    begin(work);
    AdmissibleStep const limit = look_ahead(work, by, work.aim);
    if (strategy == Strategy::linear) work.report.limit = limit;
    if (!(limit.step > 1) || !is_valid(work, mesh.ahead())) return;
    work.attempt.strategy = strategy;
    work.attempt.other = other;
    take_step(work, by);
    keep_if_better(work);
}

// Goes straight ahead with the functions of the start, as far as no cell is inverted. No other
// strategy ends with a worse mesh than this one.
void SafeMorph::longest_linear_step(Work& work) noexcept {
    constexpr Index max_trials = 8;
    if (mesh.path.is_bent())
        return;  // the derivative of a path that turns does not fit a straight step
    begin(work);
    Real length = min(0.98 * look_ahead(work, work.basis, work.aim).step, 1.0) * work.aim;
    for (Index trial = 0; trial < max_trials && length > work.best().fraction;
         ++trial, length *= 0.8) {
        look_ahead(work, work.basis, length);
        if (!is_valid(work, mesh.ahead())) continue;
        take_step(work, work.basis);
        keep_if_better(work);
        return;
    }
}

// Checks the coordinates as they will be stored, after all roundings: every corner must be
// positive, both in exact arithmetic and in the measure of quality, and the boundary must not cross
// itself except where it did so at the start.
bool SafeMorph::is_valid(Work const& work, Points points) const noexcept {
    for (Index k = 0; k < best_x.count(); ++k) {
        if (!is_coordinate(points[k])) return false;
    }
    return count_inverted(work.cells(), points, work.executor()) == 0 &&
           !find_new_crossing(work.basis.faces(), work.mesh().points, points).found;
}

// Makes the trial step, the mesh of which is valid.
void SafeMorph::take_step(Work& work, Basis const& by) noexcept {
    if (work.derivative != nullptr) {
        for (Index i = 0; i < weight.count(); ++i) {
            weight[i] = mesh.path.weight(i, mesh.aimed_time) - mesh.path.weight(i, mesh.time);
        }
        add_weighted(*work.derivative, by, weight, work.executor());
        turn_slipping(work);
    }
    mesh.advance();
    work.attempt.turned_offset = mesh.carried.largest(work.basis, mesh.path, mesh.time);
    work.attempt.fraction = mesh.time;
    ++work.attempt.steps;
}

// Turns the derivative of the last trial step at points that slip along curves, which the step
// puts back onto their curves.
void SafeMorph::turn_slipping(Work const& work) const noexcept {
    SlipCurves const& curves = work.plan.equations().slip_curves();
    if (curves.count == 0) return;
    Index const half = work.derivative->row_length() / 2;  // numbers of x, then of y
    curves.for_each([&](Index slot, Index point) {
        auto const row = work.derivative->row(point);
        SlipCurves::Place const& place = mesh.slip_place[slot];
        for (Index k = 0; k < half; ++k) {
            Real const along =
                place.stretch * (place.tangent.x * row[k] + place.tangent.y * row[half + k]);
            row[k] = place.tangent.x * along;
            row[half + k] = place.tangent.y * along;
        }
    });
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        Index const same = work.plan.representative(k);
        if (work.plan.unknowns().slips(k) && same != k)
            copy_row(work.derivative->row(k), work.derivative->row(same), 2 * half);
    }
}

void SafeMorph::measure(Work const& work, Points points, Outcome& outcome) const noexcept {
    Quality const quality =
        measure_quality(work.cells(), points, work.mesh().points, work.executor());
    outcome.min_quality = quality.min_quality;
    outcome.mean_quality = quality.mean_quality();
    if (!is_finite(work.options.max_height_change)) return;
    FirstLayerChange const change = compare(first_layer, work.mesh().points, points);
    if (change.points == 0) return;
    outcome.height_change =
        max(max(change.max_ratio, change.min_ratio > 0 ? 1 / change.min_ratio : infinity), 1.0);
}

void SafeMorph::keep_if_better(Work& work) noexcept {
    measure(work, mesh.now(), work.attempt);
    if (work.is_better(work.attempt, work.best()))
        keep(work, work.attempt, mesh.x, mesh.y, mesh.reached);
}

void SafeMorph::keep(Work& work, Outcome const& outcome, Span<const Real> x, Span<const Real> y,
                     Span<const Real> movement) noexcept {
    copy(best_x, x);
    copy(best_y, y);
    copy(reached, movement);
    work.best() = outcome;
    work.derivative_of_best = true;
}

void SafeMorph::replace_inner_points(Work& work, Outcome const& outcome) noexcept {
    copy(best_x, Span<const Real>(mesh.ahead_x));
    copy(best_y, Span<const Real>(mesh.ahead_y));
    work.best() = outcome;
}

void SafeMorph::write(MutablePoints to) const noexcept {
    for (Index k = 0; k < best_x.count(); ++k) to.set(k, result()[k]);
}

}  // namespace harmorph
