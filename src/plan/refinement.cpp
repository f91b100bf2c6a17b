#include "plan/refinement.hpp"

namespace harmorph {
namespace {

// Relative residuals above this are refined. Rounding leaves less on most meshes; on very uneven
// ones one step of refinement suffices.
constexpr Real refined_above = 1e-13;
// Estimated errors above this, relative to the largest value, are refined as well.
constexpr Real certain_within = 1e-10;
// A further step is taken only if the last one reduced the residual by this factor. The estimated
// error may miss this reduction max_stalls times in a row: the first correction leaves rounding
// errors of rough right-hand sides, which are unrelated to the error that it removed.
constexpr Real shrinking = 0.5;
constexpr Index max_stalls = 1;
// Rounding of the values and of their sum makes a residual of at most this factor times (sum of
// |entries| of the row) (max |F|).
constexpr Real rounded_within = 32 * epsilon;
// Returns the largest number of steps, which suffices for steps that reduce the error by hardly
// more than `shrinking`. Iterative engines stop at their tolerance.
Index refinement_limit(Method const& method) noexcept { return method.traits().factors ? 40 : 0; }

// For nodal gradients every refinement solves for the residual by BiCGSTAB, to this reduction of
// the residual.
constexpr Real iterated_to = 1e-8;
constexpr Index max_iterations = 200;

// Returns the number of columns that are refined at a time: as many as fit into idle memory of the
// engine, but at least a few.
Index residual_width(Method const& method, Matrix const& matrix, AnyEngine const& engine,
                     Index columns) noexcept {
    if (method.nodal_gradients()) return min(columns, BiconjugateGradients::max_width);
    constexpr Offset bytes = sizeof(Real), min_columns = 5;
    Offset const n = max(matrix.n, Index{1});
    Offset const lists = 3 * n * static_cast<Offset>(sizeof(Index));
    Offset const room = max(engine.idle_bytes() - lists, Offset{0}) / (n * matrix.planes() * bytes);
    // Columns are whole blocks of the kernels, if there are at least two.
    Offset const wanted = room >= 16 ? room / 8 * 8 : max(room, min_columns);
    return static_cast<Index>(
        min(wanted, Offset{min(max(columns, Index{2}), Residual::max_width)}));
}

class RefinementRun {
public:
    RefinementRun(Refinement& with, Equations const& equations, AnyEngine& engine,
                  DofValues const& dofs, Progress const& progress) noexcept
        : equations_(equations),
          matrix_(equations.matrix()),
          method_(equations.method()),
          engine_(engine),
          dofs_(dofs),
          progress_(progress),
          residual_(with.residual),
          biconjugate_(with.biconjugate) {}

    // Computes residuals, and refines the functions whose residuals are too large.
    Status run(SolveReport& report, Fault& fault) noexcept {
        Index const n_columns = dofs_.columns(matrix_);
        for (Index first = 0, n = 0; first < n_columns; first += n) {
            if (first > 0)
                HARMORPH_TRY(
                    progress_.report(Phase::residual, static_cast<Real>(first) / n_columns, fault));
            Refined refined;
            n = min(Residual::max_width, n_columns - first);
            if (!is_accurate(first, n, refined)) {
                n = min(residual_.width, n_columns - first);
                HARMORPH_TRY(refine(first, n, refined, fault));
            }
            note(first, n, refined, report);
        }
        return Status::ok;
    }

private:
    // The results for a block of columns.
    struct Refined {
        Residual::Norms norms;
        Real error[Residual::max_width] = {};  // The estimate, relative to the largest value.
        Index steps = 0, iterations = 0;
    };

    void note(Index first, Index n, Refined const& refined, SolveReport& report) const noexcept {
        auto const take_worst = [](Real found, Index function, Real& worst, Index& where) {
            if (found <= worst || worst != worst) return;  // A NaN is kept.
            worst = found;
            where = function;
        };
        report.refinements = max(report.refinements, refined.steps);
        report.iteration.iterations = max(report.iteration.iterations, refined.iterations);
        for (Index k = 0; k < n; ++k) {
            Index const function = dofs_.first_function + (first + k) % dofs_.n_functions;
            take_worst(refined.error[k], function, report.error, report.error_function);
            Real const left = refined.norms.relative(k);
            take_worst(left, function, report.residual, report.residual_function);
            if (left <= method_.tolerance || is_only_rounding(first + k, refined.error[k]))
                continue;
            take_worst(left, function, report.missed, report.missed_function);
        }
    }

    Residual::Norms measure(Index first, Index n) const noexcept {
        if (method_.nodal_gradients())
            return equations_.nodal().compute(residual_, dofs_, first, n);
        return residual_.compute(matrix_, dofs_, first, n);
    }

    // Tells whether no refinement is needed, as is usual. This can be checked for many columns at
    // once, as no residuals are stored.
    bool is_accurate(Index first, Index n, Refined& refined) const noexcept {
        if (!engine_.trusted() || method_.nodal_gradients() ||
            matrix_.kind() == MatrixKind::coupled_xy)
            return false;
        refined.norms = residual_.measure(matrix_, dofs_, first, n);
        bool any = false;
        for (Index k = 0; k < n; ++k) any = any || !(refined.norms.relative(k) <= refined_above);
        return !any || refinement_limit(method_) == 0;
    }

    // Solves for the residual and adds the correction, until the residual is rounding or no longer
    // shrinks. Each column is treated by itself, so that its bits do not depend on the other
    // columns of the block. The reduction of the error by a step is estimated by the ratio of two
    // successive corrections; the first ratio is not used, as the right-hand sides of the first
    // step are smooth and later ones are not. The estimated error is the largest ratio times the
    // last correction, or the last correction itself if there is no ratio yet or no reduction.
    Status refine(Index first, Index n, Refined& refined, Fault& fault) noexcept {
        Residual::Choice wanted;
        // The change by a step of refinement; the change by the first solution, from 0, is 1.
        Residual::Changes change;
        Real before[Residual::max_width], left[Residual::max_width] = {};
        Index stalls[Residual::max_width] = {};
        for (Index k = 0; k < n; ++k) {
            wanted.column[k] = true;
            // For nodal gradients the functions of the compact scheme do not count as a first
            // solution.
            change.column[k] = method_.nodal_gradients() ? infinity : 1;
            before[k] = infinity;
            refined.error[k] = engine_.trusted() ? 0 : 1;
        }
        for (Real ratio[Residual::max_width] = {};; ++refined.steps) {
            refined.norms = measure(first, n);
            bool any = false;
            for (Index k = 0; k < n; ++k) {
                Real const now = refined.norms.relative(k);
                bool const large = now > refined_above && now < shrinking * before[k];
                stalls[k] = ratio[k] < shrinking ? 0 : stalls[k] + 1;
                bool const uncertain = refined.error[k] > certain_within && stalls[k] <= max_stalls;
                wanted.column[k] = wanted.column[k] && (large || uncertain);
                before[k] = now;
                any = any || wanted.column[k];
            }
            if (!any || refined.steps == refinement_limit(method_)) return Status::ok;
            HARMORPH_TRY(correct(n, refined.iterations, fault));
            Residual::Changes const last = change;
            change = residual_.add_to(matrix_, dofs_, first, n, wanted);
            for (Index k = 0; k < n; ++k) {
                if (!wanted.column[k]) continue;
                ratio[k] = change.column[k] / last.column[k];
                if (refined.steps > 0) left[k] = max(left[k], ratio[k]);
                refined.error[k] =
                    (refined.steps > 0 && ratio[k] < shrinking ? left[k] : 1) * change.column[k];
            }
        }
    }

    // Replaces the residuals of n columns by corrections, in place.
    Status correct(Index n, Index& iterations, Fault& fault) noexcept {
        Offset const row_length = Offset{matrix_.planes()} * residual_.width;
        auto const solve = [&](Real* rows) {
            return engine_.correct(Rows{rows, nullptr, row_length, n, residual_.width}, fault);
        };
        if (!method_.nodal_gradients()) return solve(residual_.value.data());
        auto const apply = [&](const Real* from, Real* to) { equations_.nodal().apply(from, to); };
        Index taken = 0;
        HARMORPH_TRY(
            biconjugate_.run(residual_.value, n, iterated_to, max_iterations, taken, apply, solve));
        iterations += taken;
        return Status::ok;
    }

    // Tells whether the residual is only rounding. Fluxes through thin cells are far larger than
    // those at the wall, and so are their rounding errors, so the residual relative to |b| is no
    // measure there. Therefore the residual is compared with the entries of the same row. A single
    // wrong value fails this test; an error common to all values of neighbouring cells passes it,
    // but refinement has estimated that error to be small. If refinement has not run, `error` is 0.
    bool is_only_rounding(Index column, Real error) const noexcept {
        bool const refined = method_.traits().factors && !method_.nodal_gradients();
        return refined && error > 0 && error <= method_.tolerance &&
               residual_.backward_error(matrix_, dofs_, column) <= rounded_within;
    }

    Equations const& equations_;
    Matrix const& matrix_;
    Method const& method_;
    AnyEngine& engine_;
    DofValues const& dofs_;
    Progress const& progress_;
    Residual const& residual_;
    BiconjugateGradients& biconjugate_;
};

}  // namespace

void SolveReport::merge(SolveReport const& others) noexcept {
    if (residual_function == none || exceeds(others.residual, residual)) {
        residual = others.residual;
        residual_function = others.residual_function;
    }
    unknowns = others.unknowns;
    factor_entries = others.factor_entries;
    refinements = max(refinements, others.refinements);
    iteration.iterations = max(iteration.iterations, others.iteration.iterations);
    iteration.work = max(iteration.work, others.iteration.work);
    iteration.levels = others.iteration.levels;
}

void Refinement::lay_out(Arena& arena, Analysis const& analysis, AnyEngine const& engine,
                         Equations& equations, Index columns) noexcept {
    Method const& method = analysis.problem().method;
    Matrix const& matrix = equations.matrix();
    residual.lay_out(arena, matrix.n, analysis.matrix_sizes().couplings, matrix.kind(),
                     residual_width(method, matrix, engine, columns));
    if (!method.nodal_gradients()) return;
    equations.lay_out_nodal_work(arena, analysis.problem().mesh.n_points, residual.width);
    if (method.traits().factors) biconjugate.lay_out(arena, matrix.n, residual.width);
}

Status Refinement::run(Equations const& equations, AnyEngine& engine, DofValues const& dofs,
                       Progress const& progress, SolveReport& report, Fault& fault) noexcept {
    return RefinementRun(*this, equations, engine, dofs, progress).run(report, fault);
}

void Refinement::measure(Equations const& equations, DofValues const& dofs,
                         SolveReport& report) const noexcept {
    Index const n_columns = dofs.columns(equations.matrix());
    bool const in_rows = equations.matrix().kind() == MatrixKind::coupled_xy;
    for (Index first = 0, n = 0; first < n_columns; first += n) {
        n = min(in_rows ? residual.width : Residual::max_width, n_columns - first);
        Residual::Norms const norms = in_rows
                                          ? residual.compute(equations.matrix(), dofs, first, n)
                                          : residual.measure(equations.matrix(), dofs, first, n);
        for (Index k = 0; k < n; ++k) {
            if (!exceeds(norms.relative(k), report.residual)) continue;
            report.residual = norms.relative(k);
            report.residual_function = dofs.first_function + (first + k) % dofs.n_functions;
        }
    }
}

Status check_accuracy(SolveReport const& report, Method const& method, Fault& fault) noexcept {
    if (!(report.missed <= method.tolerance)) {
        return fault.refuse(Status::not_converged,
                            "function # has the relative residual ~, which is above the tolerance",
                            function_item(report.missed_function), {}, report.missed);
    }
    if (!report.iteration.settled) {
        return fault.refuse(Status::not_converged,
                            "the iteration ended before the values were accurate to the tolerance");
    }
    if (report.error <= max(method.tolerance, certain_within)) return Status::ok;
    return fault.refuse(Status::not_converged,
                        "function # may have an error of ~: cells are too thin for refinement to "
                        "reduce the error",
                        function_item(report.error_function), {}, report.error);
}

}  // namespace harmorph
