// The residuals of the plan's functions, and their iterative refinement.
#include "harmorph/plan/plan.hpp"

namespace harmorph {
namespace {

// Rounding leaves less on most meshes; on very uneven ones a step of refinement brings it back. With a factor in single
// precision each step gains about six digits.
constexpr Real refined_above = 1e-13;
// And what values are thought to be off, beside the largest.
constexpr Real certain_within = 1e-10;
// Of what a step must leave less than, to be worth another; of an error, this often in a row it may leave more: what the first
// correction leaves is rounding of its rough right-hand sides, which bears no relation to the error it took away.
constexpr Real shrinking = 0.5;
constexpr Index most_stalls = 1;
// Of what a row's entries make of the largest value: what rounding of values, and of their sum, leaves there at most.
constexpr Real rounded_within = 32 * epsilon;
// Enough for a factor off by nearly that. Engines that iterate stop where they are asked to.
constexpr Index most_refinements(Method const& method) noexcept { return method.engine == Engine::direct ? 40 : 0; }

// Of a pivot's terms, what is left where some cancelled.
constexpr Real uncancelled_above = 1e-3;

// Of a diagonal, what is left of it when its turn comes: on even cells a fifth, beside thin ones thousandths. Circulations
// are no conductances, so that something cancels; so it does where cells' angles make conductances negative; and turned
// lines have no sums to rely on.
constexpr Real even_above(MatrixKind kind) noexcept { return kind == MatrixKind::two_lines ? 1.0 / 30 : 1e-5; }

}  // namespace

// Nodal gradients: all that the compact scheme's functions leave is solved for by an iteration, each time as far as this.
constexpr Real iterated_to = 1e-8;
constexpr Index most_iterations = 200;

Residual::Norms Plan::measure(Lines const& all, Index first, Index n) const noexcept {
    if (method.nodal_gradients()) return nodal.compute(residual, all, first, n);
    return residual.compute(matrix, all, first, n);
}

// In the place of the residuals, of n columns.
Status Plan::solve_rest(Index n, Index& iterations, Fault& fault) noexcept {
    Offset const row_length = Offset{engine.planes} * residual.width;
    if (!residual.single.empty()) {
        return engine.solve(RowsOf<float>{residual.single.data(), nullptr, row_length, n, residual.width}, Progress{}, fault);
    }
    auto const solve = [&](Real* rows) { return engine.solve({rows, nullptr, row_length, n, residual.width}, Progress{}, fault); };
    if (!method.nodal_gradients()) return solve(residual.value.data());
    auto const apply = [&](const Real* from, Real* to) { nodal.apply(from, residual.width, to); };
    return biconjugate.run(residual.value, n, iterated_to, most_iterations, iterations, apply, solve);
}

// What is left of the equations, and iterative refinement where that is too much.
Status Plan::refine(Basis const& basis, SolveReport& report, Fault& fault) noexcept {
    Lines const all = lines(basis);
    Index const n_columns = all.columns(matrix);
    auto const function = [&](Index column) {
        return basis.header->counts.first_held + column % basis.n_functions();
    };
    for (Index first = 0, n = 0; first < n_columns; first += n) {
        if (first > 0) HARMORPH_TRY(progress.report(Phase::residual, static_cast<Real>(first) / n_columns, fault));
        Refined its;
        n = smaller(Residual::widest, n_columns - first);
        if (!need_nothing(all, first, n, its)) {
            n = smaller(residual.width, n_columns - first);
            HARMORPH_TRY(refine_columns(all, first, n, its, fault));
        }
        report.refinements = larger(report.refinements, its.steps);
        report.iteration.iterations = larger(report.iteration.iterations, its.iterations);
        auto const note = [](Real found, Index its_function, Real& worst, Index& where) {
            if (found <= worst || worst != worst) return;  // once NaN, it stays
            worst = found;
            where = its_function;
        };
        for (Index k = 0; k < n; ++k) {
            note(its.error[k], function(first + k), report.error, report.error_function);
            Real const left = its.norms.relative(k);
            note(left, function(first + k), report.residual, report.residual_function);
            if (left <= method.tolerance || is_only_rounding(all, first + k, its.error[k])) continue;
            note(left, function(first + k), report.missed, report.missed_function);
        }
    }
    return Status::ok;
}

// Most often all is well, which is seen of many columns at once as nothing is stored.
bool Plan::need_nothing(Lines const& all, Index first, Index n, Refined& its) const noexcept {
    if (!factor_trusted || method.nodal_gradients() || matrix.kind == MatrixKind::two_lines) return false;
    its = {};
    its.norms = residual.measure(matrix, all, first, n);
    bool any = false;
    for (Index k = 0; k < n; ++k) any = any || !(its.norms.relative(k) <= refined_above);
    return !any || most_refinements(method) == 0;
}

// Beside thin cells a small residual may hide a large error, as their entries dwarf all others. Where nothing cancelled in
// the factor, there is none. That of nodal gradients is the compact scheme's.
Status Plan::test_factor(Fault& fault) noexcept {
    factor_trusted = method.engine != Engine::direct;
    if (factor_trusted || method.nodal_gradients() || method.precision == Precision::in_single) return Status::ok;
    Real const even = even_above(matrix.kind), left = engine.least_left(), pivot = engine.least_pivot();
    factor_trusted = pivot > even;
    if (matrix.kind != MatrixKind::real) return Status::ok;
    factor_trusted = left > uncancelled_above && pivot > even * (1 - left);
    if (factor_trusted || !(left > uncancelled_above)) return Status::ok;
    Real rise = 0;
    HARMORPH_TRY(raise_by_negative(rise, fault));
    factor_trusted = even * rise < 1;
    return Status::ok;
}

// Conductances that are negative, as angles of cells make them, may cancel others between the same two points, which no pivot
// shows: what is left is rounding, and flows as a conductance does. So functions are off by about as many roundings as
// sources the size of all negative conductances raise them.
Status Plan::raise_by_negative(Real& rise, Fault& fault) noexcept {
    Span<Real> const source = residual.value.first(matrix.n);
    fill(source, 0.0);
    auto const add = [&](Index row, Real entry) { source[row] += entry > 0 ? entry : 0; };  // entries: their opposites
    for (Index i = 0; i < matrix.n; ++i) {
        for (Offset e = matrix.start[i]; e < matrix.start[i + 1]; ++e) {
            add(i, matrix.value[e]);
            add(matrix.column[e], matrix.value[e]);
        }
    }
    for (Index c = 0; c < matrix.coupling_row.count(); ++c) add(matrix.coupling_row[c], matrix.coupling_value[c]);
    for (Index h = 0; h < matrix.held_row.count(); ++h) add(matrix.held_row[h], matrix.held_value[h]);
    HARMORPH_TRY(engine.solve({source.data(), nullptr, 1, 1, 1}, Progress{}, fault));
    rise = 0;
    for (Real const its : source) rise = larger(rise, absolute(its));
    return Status::ok;
}

// What is left is solved for and added, until it is rounding or no longer shrinks. Each column by itself, so that its bits
// do not depend on those solved with it. What a step leaves of an error is seen from one correction to the next, but for
// the first: its right-hand sides are smooth, the later ones' are not. The worst of that, times the last correction, is what
// values are still off; that correction itself where there is no such ratio yet, or no shrinking.
Status Plan::refine_columns(Lines const& all, Index first, Index n, Refined& its, Fault& fault) noexcept {
    Residual::Choice wanted;
    Residual::Changes change;  // by a step of refinement; the first one's was from nothing
    Real before[Residual::widest], left[Residual::widest] = {};
    Index stalls[Residual::widest] = {};
    for (Index k = 0; k < n; ++k) {
        wanted.column[k] = true;
        change.column[k] = method.nodal_gradients() ? infinity : 1;  // the compact scheme's functions are no first step
        before[k] = infinity;
        its.error[k] = factor_trusted ? 0 : 1;
    }
    for (Real ratio[Residual::widest] = {};; ++its.steps) {
        its.norms = measure(all, first, n);
        bool any = false;
        for (Index k = 0; k < n; ++k) {
            Real const now = its.norms.relative(k);
            bool const large = now > refined_above && now < shrinking * before[k];
            stalls[k] = ratio[k] < shrinking ? 0 : stalls[k] + 1;
            bool const off = its.error[k] > certain_within && stalls[k] <= most_stalls;
            wanted.column[k] = wanted.column[k] && (large || off);
            before[k] = now;
            any = any || wanted.column[k];
        }
        if (!any || its.steps == most_refinements(method)) return Status::ok;
        Index iterations = 0;
        HARMORPH_TRY(solve_rest(n, iterations, fault));
        its.iterations += iterations;
        Residual::Changes const last = change;
        change = residual.add_to(matrix, all, first, n, wanted);
        for (Index k = 0; k < n; ++k) {
            if (!wanted.column[k]) continue;
            ratio[k] = change.column[k] / last.column[k];
            if (its.steps > 0) left[k] = larger(left[k], ratio[k]);
            its.error[k] = (its.steps > 0 && ratio[k] < shrinking ? left[k] : 1) * change.column[k];
        }
    }
}

// Flows through thin cells dwarf those at the wall, and so does what rounding of values leaves of them: a residual beside |b|
// says nothing there. So it is held against the entries of its own row, which no wrong value passes that its neighbours do
// not share; and what cells share, refinement has found to be right. Where it has not looked, the error is 0.
bool Plan::is_only_rounding(Lines const& all, Index column, Real error) const noexcept {
    bool const refined = method.engine == Engine::direct && !method.nodal_gradients();
    return refined && error > 0 && error <= method.tolerance && residual.beside_entries(matrix, all, column) <= rounded_within;
}

Status Plan::judge(SolveReport const& report, Fault& fault) const noexcept {
    if (!(report.missed <= method.tolerance)) {
        return fault.refuse(Status::not_converged, "function # (from 0) has the relative residual ~, above the tolerance",
                            Counts::from_zero, report.missed_function, none, report.missed);
    }
    if (!report.iteration.settled) {
        return fault.refuse(Status::not_converged, "the iteration ended while values were still off by more than the tolerance");
    }
    if (report.error <= larger(method.tolerance, certain_within)) return Status::ok;
    bool const in_single = method.precision == Precision::in_single;
    return fault.refuse(Status::not_converged,
                        in_single ? "function # (from 0) may be off by ~: cells are too thin for a factor in single precision"
                                  : "function # (from 0) may be off by ~: cells are too thin for refinement to bring it down",
                        Counts::from_zero, report.error_function, none, report.error);
}

}  // namespace harmorph
