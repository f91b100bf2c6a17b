// The residuals of the plan's functions, and their iterative refinement.
#include "harmorph/harmonic.hpp"

namespace harmorph {
namespace {

// Rounding leaves less on most meshes; on very uneven ones a step of refinement brings it back. With a factor in single
// precision each step gains about six digits.
constexpr Real refined_above = 1e-13;
// And what values are thought to be off, beside the largest.
constexpr Real certain_within = 1e-10;
// Of what a step must leave less than, to be worth another.
constexpr Real shrinking = 0.5;
// Enough for a factor off by nearly that. Engines that iterate stop where they are asked to.
constexpr Index most_refinements(Method const& method) noexcept { return method.engine == Engine::direct ? 40 : 0; }

// Of a pivot's terms, what is left where some cancelled.
constexpr Real uncancelled_above = 1e-3;

// Of a diagonal, what is left of it when its turn comes: on even cells a fifth, beside thin ones thousandths. Circulations
// are no conductances, so that something cancels; and turned lines have no sums to rely on.
constexpr Real even_above(MatrixKind kind) noexcept { return kind == MatrixKind::complex ? 1e-5 : 1.0 / 30; }

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
    for (Index first = 0; first < n_columns; first += residual.width) {
        Index const n = smaller(residual.width, n_columns - first);
        Refined its;
        HARMORPH_TRY(refine_columns(all, first, n, its, fault));
        report.refinements = larger(report.refinements, its.steps);
        report.iteration.iterations = larger(report.iteration.iterations, its.iterations);
        auto const note = [](Real found, Index its_function, Real& worst, Index& where) {
            if (found <= worst || worst != worst) return;  // once NaN, it stays
            worst = found;
            where = its_function;
        };
        for (Index k = 0; k < n; ++k) {
            note(its.norms.relative(k), function(first + k), report.residual, report.residual_function);
            note(its.error[k], function(first + k), report.error, report.error_function);
        }
        HARMORPH_TRY(progress.report(Phase::residual, static_cast<Real>(first) / n_columns, fault));
    }
    return Status::ok;
}

// Beside thin cells a small residual may hide a large error, as their entries dwarf all others. Where nothing cancelled in
// the factor, there is none. That of nodal gradients is the compact scheme's.
bool Plan::trusts_factor() const noexcept {
    if (method.engine != Engine::direct) return true;
    if (method.nodal_gradients() || method.precision == Precision::in_single) return false;
    if (matrix.kind == MatrixKind::real) return engine.least_left() > uncancelled_above;
    return engine.least_pivot() > even_above(matrix.kind);
}

// What is left is solved for and added, until it is rounding or no longer shrinks. Each column by itself, so that its bits
// do not depend on those solved with it. What a step leaves of an error is seen from one correction to the next, but for
// the first: its right-hand sides are smooth, the later ones' are not. The worst of that, times the last correction, is what
// values are still off; that correction itself where there is no such ratio yet, or no shrinking.
Status Plan::refine_columns(Lines const& all, Index first, Index n, Refined& its, Fault& fault) noexcept {
    Residual::Choice wanted;
    Residual::Changes change;  // by a step of refinement; the first one's was from nothing
    Real before[Residual::widest], left[Residual::widest] = {};
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
            bool const off = its.error[k] > certain_within && ratio[k] < shrinking;
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

Status Plan::judge(SolveReport const& report, Fault& fault) const noexcept {
    if (!(report.residual <= method.tolerance)) {
        return fault.refuse(Status::not_converged, "function # has the relative residual ~, above the tolerance",
                            Counts::from_zero, report.residual_function, none, report.residual);
    }
    if (!report.iteration.settled) {
        return fault.refuse(Status::not_converged, "the iteration ended while values were still off by more than the tolerance");
    }
    if (report.error <= larger(method.tolerance, certain_within)) return Status::ok;
    bool const in_single = method.precision == Precision::in_single;
    return fault.refuse(Status::not_converged,
                        in_single ? "function # may be off by ~: cells are too thin for a factor in single precision"
                                  : "function # may be off by ~: cells are too thin for refinement to bring it down",
                        Counts::from_zero, report.error_function, none, report.error);
}

}  // namespace harmorph
