// A safe morph in several steps: the functions are solved again on the moved mesh, by another
// operator if the present one allows short steps only.
#include "safe/safe_work.hpp"

namespace harmorph {
namespace {

// A substep takes this part of the admissible step.
constexpr Real substep_of_admissible = 0.5;
// Steps that are shorter than this part of the whole movement do not help.
constexpr Real min_substep = 1e-4;
// The largest number of trials of the length of a substep, which are needed because the path is not
// straight.
constexpr Index max_trials = 12;
// The number of solutions that should suffice for a large movement.
constexpr Index usual_resolves = 5;
// The largest number of leaps over the rest of the movement before all solutions are used up.
constexpr Index max_leaps = 2;
// The most that the untangling after a leap may cost, in solutions. Those that succeed take less
// than two in most meshes.
constexpr Real untangling_on_the_way = 4, last_untangling = 16;
// A step is too short if it is less than this part of the pace that leads to the target with the
// remaining solutions.
constexpr Real stuck_below = 0.5;
// An operator replaces the present one if its step is longer by this factor.
constexpr Real worth_changing = 1.5;

}  // namespace

struct SafeMorph::OperatorChoice {
    Operator kind;
    Index exponent_quarters;
};

// The operator of the basis, and those operators that may help if it allows short steps only.
// Conformal functions do not follow movements that shear cells, such as bodies that pass each
// other. Their exponent decides which region keeps its shape: 1 deforms cells far away, 2 keeps
// those near the wall.
struct SafeMorph::Operators {
    OperatorChoice list[4];
    Index count = 0, current = 0;
    // The number of steps without a trial of another operator, after a trial that did not help.
    Index rest = 0;

    OperatorChoice const& now() const noexcept { return list[current]; }

    void add(OperatorChoice choice) noexcept {
        for (Index k = 0; k < count; ++k) {
            if (list[k].kind == choice.kind &&
                list[k].exponent_quarters == choice.exponent_quarters)
                return;
        }
        list[count++] = choice;
    }

    explicit Operators(Method const& method) noexcept {
        add({method.operator_kind, method.exponent_quarters});
        if (method.conformal()) add({Operator::conformal, 4});
        if (method.operator_kind != Operator::laplace) add({Operator::laplace, 0});
    }
};

// Makes the whole movement at once with functions of other operators that are solved at the start.
Status SafeMorph::other_operators(Work& work) noexcept {
    begin(work);
    Basis const here = copy_to_solve(work);
    Operators const operators(work.basis.header->method);
    for (Index k = 1; k < operators.count && work.resolves() < work.options.max_resolves; ++k) {
        if (operators.list[k].kind == operators.list[0].kind && work.is_good(work.best())) continue;
        Status const status = solve_by(work, here, operators.list[k]);
        if (status == Status::cancelled) return status;
        if (failed(status)) continue;
        single_step(work, here, Strategy::other, static_cast<Index>(operators.list[k].kind));
        if (work.is_fair(work.best())) break;
        mesh.begin(work.plan);
    }
    return Status::ok;
}

Status SafeMorph::substeps(Work& work) noexcept {
    begin(work);
    Basis const here = copy_to_solve(work);
    Operators operators(work.basis.header->method);
    Index leaps = work.derivative == nullptr && !work.searches
                      ? max_leaps
                      : 0;  // the derivative does not include movements by untangling
    // After a solution that failed, `here` may contain any values; the functions of the start can
    // always be used.
    const Basis* by = &work.basis;
    bool const resumes = work.searches && work.derivative == nullptr;
    if (resumes) resume(work);
    if (work.options.tries(Strategy::substeps)) {
        Real length = 0;
        if (!resumes) {
            by = &choose_first(work, length);
        } else if (!failed(solve_by(work, here, operators.now()))) {
            by = &here;
            length = find_step(work, here);
        }
        while (length >= min_substep) {
            work.attempt.strategy = Strategy::substeps;
            take_step(work, *by);
            bool const is_there = work.arrives(work.attempt);
            if (work.attempt.fraction < 1) improve_on_the_way(work);
            if (is_there || work.derivative == nullptr) keep_if_better(work);
            if (is_there) return Status::ok;
            if (work.resolves() >= work.options.max_resolves) break;
            Status status = solve_by(work, here, operators.now());
            if (!failed(status)) {
                by = &here;
                length = find_step(work, here);
                bool const is_late = work.resolves() >= usual_resolves;
                if ((is_late || is_stuck(work, length)) && leaps > 0) {
                    --leaps;
                    if (leap(work, here, false)) return Status::ok;
                }
                status = is_stuck(work, length) ? change_operator(work, here, operators, length)
                                                : Status::ok;
            }
            if (status == Status::cancelled) return status;
            by = here.header->solved == 1 ? &here : &work.basis;
            if (failed(status)) break;  // the scheme does not apply, or the mesh is too poor
            if (length >= min_substep) look_ahead(work, here, min(mesh.time + length, work.aim));
        }
        if (work.attempt.steps > 0 && work.derivative != nullptr) keep_if_better(work);
    }
    if (!resumes || work.aim < 1) leap(work, *by, true);
    return Status::ok;
}

// Returns whether a step is too short to reach the target with the remaining solutions.
bool SafeMorph::is_stuck(Work const& work, Real length) const noexcept {
    Real const left = static_cast<Real>(max(work.options.max_resolves - work.resolves(), Index{1}));
    return length < stuck_below * (work.aim - mesh.time) / left;
}

// Returns the given basis, or the other basis with the longest step if the step of the given one is
// too short. All these bases were solved at the start.
Basis const& SafeMorph::choose_first(Work& work, Real& length) noexcept {
    const Basis* best = &work.basis;
    const Basis* last = best;
    length = find_step(work, *best);
    if (work.options.tries(Strategy::other) && length < work.aim) {
        for (Basis const& other : work.options.others) {
            if (work.derivative != nullptr && other.kind() != work.basis.kind()) continue;
            Real const step = find_step(work, other);
            last = &other;
            if (step <= worth_changing * length) continue;
            length = step;
            best = &other;
        }
    }
    if (last != best && length > 0) look_ahead(work, *best, min(mesh.time + length, work.aim));
    return *best;
}

// Changes to the operator with the longest step if the step of the present one, which was solved
// last, is too short.
Status SafeMorph::change_operator(Work& work, Basis const& here, Operators& operators,
                                  Real& length) noexcept {
    if (operators.rest > 0) {
        --operators.rest;
        return Status::ok;
    }
    Index const first = operators.current;
    Index solved = first;
    for (Index k = 1; k < operators.count && is_stuck(work, length); ++k) {
        Index const number = (first + k) % operators.count;
        if (work.resolves() + 2 > work.options.max_resolves)
            break;  // it may have to be solved twice
        Status const status = solve_by(work, here, operators.list[number]);
        if (status == Status::unsupported) continue;
        HARMORPH_TRY(status);
        solved = number;
        Real const step = find_step(work, here);
        if (step <= worth_changing * length) continue;
        length = step;
        operators.current = number;
    }
    if (operators.current == first && solved != first) operators.rest = 3;
    return solved == operators.current ? Status::ok : solve_by(work, here, operators.now());
}

// Solves the functions of an operator on the present mesh. Status::unsupported means that the
// conditions do not allow this operator, or that no solution is left.
Status SafeMorph::solve_by(Work& work, Basis const& here, OperatorChoice const& choice) noexcept {
    if (work.solutions_left() == 0) return Status::unsupported;
    Method& method = here.header->method;
    bool const is_new =
        method.operator_kind != choice.kind || method.exponent_quarters != choice.exponent_quarters;
    if (!work.plan.equations().change_operator(choice.kind, choice.exponent_quarters) && is_new)
        return Status::unsupported;
    method.operator_kind = choice.kind;
    method.exponent_quarters = choice.exponent_quarters;
    return solve_at_present(work, here);
}

// Returns the longest step, in parts of the whole movement, that takes no more than its share of
// the admissible step and leaves enough quality for the rest. The criterion of quality never makes
// a step shorter than the pace that leads to the target.
Real SafeMorph::find_step(Work& work, Basis const& by) noexcept {
    Index const planned = min(usual_resolves, work.options.max_resolves);
    Index const max_resolves = work.resolves() < planned ? planned : work.options.max_resolves;
    Real const pace = (work.aim - mesh.time) /
                      static_cast<Real>(max(max_resolves - work.resolves(), Index{0}) + 1);
    Real length = work.aim - mesh.time;
    for (Index trial = 0; trial < max_trials && length >= min_substep; ++trial) {
        Real const end = min(mesh.time + length, work.aim);
        work.report.limit = look_ahead(work, by, end);
        Real const share = work.report.limit.step * substep_of_admissible;
        if (share >= 1 && is_valid(work, mesh.ahead())) {
            if (length <= 1.001 * pace || work.goal() == 0) return length;
            Outcome there;
            measure(work, mesh.ahead(), there);
            if (there.min_quality >=
                work.report.start_quality * complex_power({work.options.min_quality, 0}, end).x)
                return length;
            length = max(0.7 * length, pace);
            continue;
        }
        length *= clamp(0.99 * share, 0.05, share >= 1 ? 0.5 : 0.9);
    }
    return 0;
}

// Returns a copy of the basis, in which functions are solved on the way. Values are copied only if
// they are needed.
Basis SafeMorph::copy_to_solve(Work const& work) const noexcept {
    Basis const& basis = work.basis;
    const auto* const begin = reinterpret_cast<const unsigned char*>(basis.header);
    const auto* const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    // The values of derived functions include those on the wall, which are stored nowhere else.
    bool const continues = work.plan.equations().method().traits().continues;
    bool const has_values = continues || basis.header->counts.derived();
    Size const values = has_values ? basis.value.size() * sizeof(Real) : 0;
    std::memcpy(block.data(), begin, static_cast<Size>(end - begin) + values);
    Basis const copy = Basis::view(static_cast<void*>(block.data()));
    if (!continues) copy.unseal();
    return copy;
}

// A solution that does not converge causes a warning, and the morph continues.
Status SafeMorph::solve_at_present(Work& work, Basis const& basis) noexcept {
    SolveReport solved;
    Fault why;
    mesh.carried.forget();
    work.factored_again = true;
    Status status = work.plan.factor(mesh.now(), why);
    if (failed(status)) basis.unseal();
    if (!failed(status)) status = work.plan.solve(basis, solved, why, Sealing::skipped);
    if (status != Status::ok && (!failed(status) || status == Status::cancelled)) work.fault = why;
    HARMORPH_TRY(status);
    ++work.report.resolves;
    return status;
}

// These strategies of a safe morph place inner points: untangling at the target, and improvement
// there.

// Corrects slipping points ahead of the present mesh, which is valid. If some of them have passed a
// neighbour on their line, as happens beside the end of a wall that leaves the line, all slipping
// points go only a part of their way, or stay. Returns whether any point slips.
bool SafeMorph::keep_order_of_slipping(Work const& work) noexcept {
    BoundaryFaces const faces = work.basis.faces();
    auto const slips = [&](Index point) {
        return mobility.held[mobility.representative[point]] == 0 &&
               work.plan.equations().kind(point) == PointKind::slip;
    };
    bool any = false;
    for (Index k = 0; k < work.mesh().n_points && !any; ++k) any = slips(k);
    if (!any) return false;
    Real part = 1;
    auto const ahead = [&](Index point) {
        Vec2 const there = mesh.ahead()[point], here = mesh.now()[point];
        return slips(point) && part < 1
                   ? mobility.slipping.placed(point, here + part * (there - here))
                   : there;
    };
    auto const is_in_order = [&] {
        for (Index face = 0; face < faces.count(); ++face) {
            Index const begin = faces.begin_of(face), end = faces.end_of(face);
            if (!slips(begin) && !slips(end)) continue;
            Vec2 const side = mesh.now()[end] - mesh.now()[begin];
            if (!(dot(side, ahead(end) - ahead(begin)) > 0)) return false;
        }
        return true;
    };
    constexpr Real parts[] = {0.5, 0.25, 0};
    for (Index k = 0; k < 3 && !is_in_order(); ++k) part = parts[k];
    if (part == 1 || !is_in_order()) return true;
    for (Index k = 0; k < work.mesh().n_points; ++k) {
        if (slips(k)) mesh.to_ahead().set(k, ahead(k));
    }
    return true;
}

// Untangles the mesh ahead with all boundary points held, and if that fails, with points that
// slip.
bool SafeMorph::untangle_ahead(Work& work, Real max_work) noexcept {
    mobility.find(work.plan, mesh.ahead());
    bool const any_slips = keep_order_of_slipping(work);
    untangling.executor = work.executor();
    auto const run = [&](Tangle const& tangle, SlippingPoints const& slipping) {
        Fault why;
        untangling.tangle = tangle;
        untangling.slipping = slipping;
        UntangleOptions options = work.options.untangle;
        options.max_work = min(max_work, static_cast<Real>(work.solutions_left()));
        Status const status = untangling.run(options, mesh.to_ahead(), work.report.untangle, why);
        work.report.untangling += work.report.untangle.work;
        // A boundary may cross itself although no cell is inverted.
        return status == Status::ok && is_valid(work, mesh.ahead());
    };
    Points const start = work.mesh().points;
    if (run({work.mesh(), start, work.basis.reversed, mesh.representative, mesh.held}, {}))
        return true;
    return any_slips && run(mobility.tangle(work.plan, start), mobility.slipping);
}

// Makes the rest of the movement in one step, however many cells the step inverts; then untangling
// places the inner points, and improvement follows where cells are poor. Returns whether the mesh
// is then good. If the mesh is not good, and this is not the last strategy, the morph continues
// from the mesh before the step.
bool SafeMorph::leap(Work& work, Basis const& by, bool is_last) noexcept {
    if (!work.options.tries(Strategy::untangled)) return false;
    look_ahead(work, by, work.aim);
    if (!untangle_ahead(work, is_last ? last_untangling : untangling_on_the_way)) return false;
    Fault why;
    Outcome there = work.attempt;
    there.strategy = Strategy::untangled;
    there.fraction = work.aim;
    ++there.steps;
    there.rotated_offset = mesh.carried.largest(work.basis, mesh.path, work.aim);
    measure(work, mesh.ahead(), there);
    if (!work.is_good(there) && work.options.tries(Strategy::improved)) {
        there.strategy = Strategy::improved;
        if (failed(MeshImprovement::check(work.plan, work.mesh().points, mesh.ahead(), why)))
            return false;
        work.report.may_improve =
            run_improvement(work, work.options.improve.max_solutions, mesh.ahead());
        if (!is_valid(work, mesh.ahead())) return false;
        measure(work, mesh.ahead(), there);
    }
    bool const is_good = work.is_good(there);
    work.note(there);
    if (is_last || is_good) take_step(work, by);
    if (work.is_better(there, work.best()))
        keep(work, there, mesh.ahead_x, mesh.ahead_y, mesh.aimed);
    return is_good;
}

// Improves a mesh with the movement of the best mesh, to the mesh ahead. Returns whether the limit
// of solutions ended the improvement.
bool SafeMorph::run_improvement(Work& work, Index max_solutions, Points from) noexcept {
    ImproveOptions options = work.options.improve;
    options.max_solutions = min(max_solutions, work.solutions_left());
    options.spent = work.report.solutions();
    ImproveReport report;
    improvement.run(work.plan, options, work.mesh().points, from, report);
    improvement.write(mesh.to_ahead());
    work.report.improvements += report.solutions;
    return !report.converged;
}

// Improves the mesh `from`, which has the same movement as the best mesh, and keeps the result if
// it is clearly better than the best mesh; if the options ask for improvement, if it is better at
// all. The derivative remains that of the path.
bool SafeMorph::improve(Work& work, Points from) noexcept {
    constexpr Real rounding = 1e-9;
    Fault why;
    if (!work.arrives(work.best()) || work.solutions_left() == 0) return false;
    if (failed(MeshImprovement::check(work.plan, work.mesh().points, from, why))) return false;
    work.report.may_improve = run_improvement(work, work.options.improve.max_solutions, from);
    Outcome outcome = work.best();
    measure(work, mesh.ahead(), outcome);
    // If improvement is asked for, any gain is kept.
    Real const needed = work.options.improves ? 1 : SafeOptions::clear_gain;
    bool const is_clear = outcome.min_quality >= (1 - rounding) * work.best().min_quality &&
                          outcome.min_quality * outcome.mean_quality >
                              needed * work.best().min_quality * work.best().mean_quality;
    bool const is_better = work.score(outcome) > work.score(work.best()) ||
                           (work.score(outcome) == work.score(work.best()) && is_clear);
    if (!is_better || !is_valid(work, mesh.ahead())) return false;
    outcome.strategy = Strategy::improved;
    replace_inner_points(work, outcome);
    return true;
}

// Improves the present mesh between two substeps, where its cells are poor: functions that are
// solved on a better mesh carry the mesh farther, and to better cells.
void SafeMorph::improve_on_the_way(Work& work) noexcept {
    constexpr Real poor = 0.5;  // in parts of the smallest quality of the start
    Index const max_solutions = work.searches ? 4 : 2;
    if (work.derivative != nullptr || !work.options.tries(Strategy::improved)) return;
    Outcome here;
    Fault why;
    measure(work, mesh.now(), here);
    if (here.min_quality >= poor * work.report.start_quality || work.solutions_left() == 0) return;
    if (failed(MeshImprovement::check(work.plan, work.mesh().points, mesh.now(), why))) return;
    run_improvement(work, max_solutions, mesh.now());
    copy(mesh.x, Span<const Real>(mesh.ahead_x));
    copy(mesh.y, Span<const Real>(mesh.ahead_y));
}

// Restores heights near the walls and improves cells, as far as the options ask for this.
// Improvement from the mesh without restored heights may give better cells than improvement from
// the mesh with them.
void SafeMorph::improve_at_end(Work& work) noexcept {
    SafeOptions const& options = work.options;
    bool const improves = options.improves && options.tries(Strategy::improved);
    copy(mesh.x, Span<const Real>(best_x));
    copy(mesh.y, Span<const Real>(best_y));
    if (options.heights > 0) restore_heights(work);
    bool const is_improved = work.best().strategy == Strategy::improved && work.report.heights == 0;
    if (improves && !is_improved) improve(work, result());
    if (improves && work.report.heights > 0 && improve(work, mesh.now())) work.report.heights = 0;
    bool const is_limited = work.best().height_change > options.max_height_change;
    if (is_limited && options.heights == 0) restore_heights(work);
}

}  // namespace harmorph
