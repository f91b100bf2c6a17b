// The residuals of the plan's functions, and their iterative refinement.
#include "harmorph/harmonic.hpp"

namespace harmorph {
namespace {

// Rounding leaves less on most meshes; on very uneven ones a step of refinement brings it back. With a factor in single
// precision each step gains about six digits.
constexpr Real refined_above = 1e-13;
// Engines that iterate stop where they are asked to.
constexpr Index most_refinements(Method const& method) noexcept {
    if (method.engine != Engine::direct) return 0;
    return method.precision == Precision::in_single ? 8 : 2;
}

}  // namespace

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
        Index steps = 0;
        HARMORPH_TRY(refine_columns(all, first, n, norms, steps, fault));
        report.refinements = larger(report.refinements, steps);
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

// What is left is solved for and added, until it is rounding or no longer shrinks. Each column by itself, so that its bits
// do not depend on those solved with it.
Status Plan::refine_columns(Lines const& all, Index first, Index n, Residual::Norms& norms, Index& steps,
                            Fault& fault) noexcept {
    Offset const row_length = Offset{engine.planes} * residual.width;
    Residual::Choice wanted;
    Real before[Residual::widest];
    for (Index k = 0; k < n; ++k) {
        wanted.column[k] = true;
        before[k] = infinity;
    }
    for (;; ++steps) {
        norms = residual.compute(matrix, all, first, n);
        bool any = false;
        for (Index k = 0; k < n; ++k) {
            Real const now = norms.relative(k);
            wanted.column[k] = wanted.column[k] && now > refined_above && now < 0.5 * before[k];
            before[k] = now;
            any = any || wanted.column[k];
        }
        if (!any || steps == most_refinements(method)) return Status::ok;
        HARMORPH_TRY(engine.solve({residual.value.data(), nullptr, row_length, n, residual.width}, Progress{}, fault));
        residual.add_to(matrix, all, first, n, wanted);
    }
}

}  // namespace harmorph
