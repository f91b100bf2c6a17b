// A safe morph in several steps: the functions are solved again on the mesh as it moves, by another operator where the one at
// hand is stuck.
#include "safe_work.hpp"

namespace harmorph {
namespace {

constexpr Real substep_of_admissible = 0.5;  // that a substep may take
constexpr Real least_step = 1e-4;          // of the whole way; shorter ones lead nowhere
constexpr Index most_trials = 12;          // of a substep's length; the way is not straight
constexpr Index usual_resolves = 5;        // what a large movement should do with
constexpr Real stuck_below = 0.5;          // of the pace that leads to the target with the resolves that are left
constexpr Real worth_changing = 1.5;       // an operator that goes so much farther is the one from now on

struct OperatorChoice {
    Operator kind;
    Index quarters;
};

}  // namespace

// The basis's own operator, and those that may help where it is stuck. Conformal functions do not follow what shears cells,
// as bodies that pass each other do; and their exponent decides what is kept: 1 bends far, 2 keeps what is near the wall.
struct SafeMorph::Operators {
    OperatorChoice list[4];
    Index count = 0, current = 0;
    Index rest = 0;  // solutions for which no change is tried, after one that did not help

    void add(OperatorChoice choice) noexcept {
        for (Index k = 0; k < count; ++k) {
            if (list[k].kind == choice.kind && list[k].quarters == choice.quarters) return;
        }
        list[count++] = choice;
    }

    explicit Operators(Method const& method) noexcept {
        add({method.operator_kind, method.quarters});
        if (method.conformal()) add({Operator::conformal, 4});
        if (method.operator_kind != Operator::laplace) add({Operator::laplace, 0});
    }
};

Status SafeMorph::substeps(Work& work) noexcept {
    begin(work);
    Basis const here = unsolved_copy(work.basis);
    Operators operators(work.basis.header->method);
    // A solution that failed may have left anything in `here`; the functions of the start always serve.
    const Basis* by = &work.basis;
    if (work.options.tries(Strategy::substeps)) {
        Real length = 0;
        by = &choose_first(work, length);
        while (length >= least_step) {
            work.attempt.strategy = Strategy::substeps;
            take_step(work, *by);
            if (work.attempt.fraction >= 1) {
                keep_if_better(work);
                return Status::ok;
            }
            if (work.report.resolves >= work.options.most_resolves) break;
            Status const status = find_step_by_operators(work, here, operators, length);
            if (status == Status::cancelled) return status;
            by = here.header->solved == 1 ? &here : &work.basis;
            if (failed(status)) break;  // a scheme that cannot, or a mesh too poor
        }
        if (work.attempt.steps > 0) keep_if_better(work);
    }
    if (!work.options.tries(Strategy::untangled) || work.best().fraction >= 1) return Status::ok;
    return untangle(work, *by);
}

// At the start all bases are there: the one that goes farthest, if the own one is stuck.
Basis const& SafeMorph::choose_first(Work& work, Real& length) noexcept {
    const Basis* best = &work.basis;
    const Basis* last = best;
    length = find_step(work, *best);
    if (work.options.tries(Strategy::other) && length < 1) {
        for (Basis const& other : work.options.others) {
            if (work.derivative != nullptr && other.kind() != work.basis.kind()) continue;
            Real const its = find_step(work, other);
            last = &other;
            if (its <= worth_changing * length) continue;
            length = its;
            best = &other;
        }
    }
    if (last != best && length > 0) look_ahead(work, *best, smaller(mesh.time + length, 1.0));
    return *best;
}

// Solves on the mesh as it is and finds the step that follows; tries other operators where that is too short.
Status SafeMorph::find_step_by_operators(Work& work, Basis const& here, Operators& operators, Real& length) noexcept {
    Real best = -1;
    Index const first = operators.current;
    Index solved = none;
    auto const solve = [&](Index number) {
        OperatorChoice const choice = operators.list[number];
        if (!work.plan.equations.change_operator(choice.kind, choice.quarters)) {
            return number == first ? Status::ok : Status::unsupported;
        }
        here.header->method.operator_kind = choice.kind;
        here.header->method.quarters = choice.quarters;
        return Status::ok;
    };
    for (Index k = 0; k < operators.count; ++k) {
        Index const number = (first + k) % operators.count;
        if (k > 0 && work.report.resolves + 2 > work.options.most_resolves) break;  // it may have to be solved twice
        if (failed(solve(number))) continue;
        HARMORPH_TRY(solve_at_present(work, here));
        solved = number;
        Real const its = find_step(work, here);
        if (its > (k == 0 ? 0 : worth_changing) * best || k == 0) {
            best = its;
            operators.current = number;
        }
        Real const left = static_cast<Real>(larger(work.options.most_resolves - work.report.resolves, Index{1}));
        bool const is_stuck = best < stuck_below * (1 - mesh.time) / left;
        if (!is_stuck || operators.rest > 0) break;
    }
    operators.rest = operators.rest > 0 ? operators.rest - 1 : operators.current == first && solved != first ? 3 : 0;
    length = best;
    if (solved != operators.current) {
        solve(operators.current);
        HARMORPH_TRY(solve_at_present(work, here));
        if (length > 0) look_ahead(work, here, smaller(mesh.time + length, 1.0));
    }
    return Status::ok;
}

// The longest step from here, in parts of the whole way, that takes no more than its share of what is admissible and leaves
// enough quality for the rest. For quality no step becomes shorter than the pace that leads to the target.
Real SafeMorph::find_step(Work& work, Basis const& by) noexcept {
    Index const planned = smaller(usual_resolves, work.options.most_resolves);
    Index const most = work.report.resolves < planned ? planned : work.options.most_resolves;
    Real const pace = (1 - mesh.time) / static_cast<Real>(larger(most - work.report.resolves, Index{0}) + 1);
    Real length = 1 - mesh.time;
    for (Index trial = 0; trial < most_trials && length >= least_step; ++trial) {
        Real const end = smaller(mesh.time + length, 1.0);
        work.report.limit = look_ahead(work, by, end);
        Real const share = work.report.limit.step * substep_of_admissible;
        if (share >= 1 && is_valid(work, mesh.ahead())) {
            if (length <= 1.001 * pace || work.goal() == 0) return length;
            Outcome there;
            measure(work, mesh.ahead(), there);
            if (there.min_quality >= work.report.start_quality * complex_power({work.options.min_quality, 0}, end).x) return length;
            length = larger(0.7 * length, pace);
            continue;
        }
        length *= clamp(0.99 * share, 0.05, share >= 1 ? 0.5 : 0.9);
    }
    return 0;
}

// All but the values stays as it is.
Basis SafeMorph::unsolved_copy(Basis const& basis) const noexcept {
    auto const begin = reinterpret_cast<const unsigned char*>(basis.header);
    auto const end = reinterpret_cast<const unsigned char*>(basis.value.data());
    std::memcpy(block.data(), begin, static_cast<Size>(end - begin));
    Basis const copy = Basis::view(static_cast<void*>(block.data()));
    copy.unseal();
    return copy;
}

// Not converged: a warning, and on.
Status SafeMorph::solve_at_present(Work& work, Basis const& basis) noexcept {
    SolveReport solved;
    Fault why;
    basis.unseal();
    mesh.carried.forget();
    Status status = work.plan.factor(mesh.now(), why);
    if (!failed(status)) status = work.plan.solve(basis, solved, why);
    if (status != Status::ok && (!failed(status) || status == Status::cancelled)) work.fault = why;
    HARMORPH_TRY(status);
    ++work.report.resolves;
    return status;
}

}  // namespace harmorph
