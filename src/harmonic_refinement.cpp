// The residuals of the plan's functions, and their iterative refinement.
#include "harmorph/harmonic.hpp"

namespace harmorph {
namespace {

// Rounding leaves less on most meshes; on very uneven ones a step of refinement brings it back. With a factor in single
// precision each step gains about six digits.
constexpr Real refined_above = 1e-13;
// And what values are thought to be off, beside the largest.
constexpr Real certain_within = 1e-10;
// Engines that iterate stop where they are asked to.
constexpr Index most_refinements(Method const& method) noexcept {
    if (method.engine != Engine::direct) return 0;
    if (method.nodal_gradients()) return 4;
    return 8;
}

// The largest ratio of a diagonal, whose rounding is at stake, to what is left of it when its turn comes: on even cells
// about 5, beside thin ones thousands.
constexpr Real even_below = 30;

template <class Number>
Real worst_pivot(Multifrontal const& engine, Matrix const& matrix) noexcept {
    Real most = 1;
    for (Index node = 0; node < engine.tree.count; ++node) {
        dense::Panel<Number> const panel = engine.panel<Number>(node);
        for (Index pivot = 0; pivot < panel.pivots; ++pivot) {
            Real const inverse = panel.row(pivot)[pivot];  // of the pivot's root
            most = larger(most, matrix.diagonal[engine.tree.nodes[node].begin + pivot] * inverse * inverse);
        }
    }
    return most;
}

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
    report.residual = 0;
    report.residual_function = none;
    report.refinements = 0;
    for (Index first = 0; first < n_columns; first += residual.width) {
        Index const n = smaller(residual.width, n_columns - first);
        Residual::Norms norms;
        SolveReport its;
        HARMORPH_TRY(refine_columns(all, first, n, norms, its, fault));
        report.refinements = larger(report.refinements, its.refinements);
        report.iteration.iterations = larger(report.iteration.iterations, its.iteration.iterations);
        for (Index k = 0; k < n; ++k) {
            Real const relative = norms.relative(k);
            bool const worse = relative > report.residual || relative != relative;  // once NaN, it stays
            if (!worse) continue;
            report.residual = relative;
            report.residual_function = basis.header->counts.first_held + (first + k) % basis.n_functions();
        }
        HARMORPH_TRY(progress.report(Phase::residual, static_cast<Real>(first) / n_columns, fault));
    }
    return Status::ok;
}

// Beside thin cells a small residual may hide a large error, as their entries dwarf all others, and so may the
// diagonal's rounding. But one solution is known: of values that are all 1 where they are known. What the factor is off
// there is what it is off elsewhere, and what a step of refinement leaves of an error. It costs a solve: pivots tell
// where there is no need.
Status Plan::measure_factor(Fault& fault) noexcept {
    factor_error = 0;
    if (method.engine != Engine::direct || method.nodal_gradients()) return Status::ok;
    if (matrix.kind == MatrixKind::two_lines) return Status::ok;
    bool const in_single = method.precision == Precision::in_single;
    Real const worst = in_single ? worst_pivot<float>(engine, matrix) : worst_pivot<double>(engine, matrix);
    if (worst < even_below) return Status::ok;
    residual.set_constant(matrix);
    HARMORPH_TRY(engine.solve({residual.value.data(), nullptr, engine.planes, 1, 1}, Progress{}, fault));
    factor_error = residual.off_constant(matrix);
    return Status::ok;
}

// What is left is solved for and added, until it is rounding or no longer shrinks. Each column by itself, so that its bits
// do not depend on those solved with it.
Status Plan::refine_columns(Lines const& all, Index first, Index n, Residual::Norms& norms, SolveReport& its,
                            Fault& fault) noexcept {
    Residual::Choice wanted;
    Residual::Changes change, last;  // by a step of refinement; the first one's was from nothing
    Real before[Residual::widest];
    for (Index k = 0; k < n; ++k) {
        wanted.column[k] = true;
        change.column[k] = 1;
        before[k] = last.column[k] = infinity;
    }
    for (;; ++its.refinements) {
        norms = measure(all, first, n);
        bool any = false;
        for (Index k = 0; k < n; ++k) {
            Real const now = norms.relative(k);
            bool const large = now > refined_above && now < 0.5 * before[k];
            Real const error = factor_error * change.column[k];
            bool const off = error > certain_within && change.column[k] < 0.5 * last.column[k];
            wanted.column[k] = wanted.column[k] && (large || off);
            before[k] = now;
            any = any || wanted.column[k];
        }
        if (!any || its.refinements == most_refinements(method)) return Status::ok;
        Index iterations = 0;
        HARMORPH_TRY(solve_rest(n, iterations, fault));
        its.iteration.iterations += iterations;
        last = change;
        change = residual.add_to(matrix, all, first, n, wanted);
    }
}

}  // namespace harmorph
