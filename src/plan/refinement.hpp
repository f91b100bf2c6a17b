// Iterative refinement: residuals of the solved functions, estimates of errors, and corrections.
#pragma once

#include "direct/bicgstab.hpp"
#include "plan/engine.hpp"

namespace harmorph {

struct SolveReport {
    Index unknowns = 0, functions = 0;
    Real residual = 0;
    Index residual_function = none;
    Real missed = 0;  // largest residual that rounding of accurate values does not explain
    Index missed_function = none;
    Index refinements = 0;
    Real error = 0;  // of the direct engine: estimate, relative to the largest value
    Index error_function = none;
    IterationReport iteration;
    Offset factor_entries = 0;

    // Of more functions.
    void take(SolveReport const& others) noexcept;
};

struct Refinement {
    Residual residual;
    BiconjugateGradients biconjugate;  // nodal gradients with an engine that factors

    // Called after the engine: overlaps with working space that the engine needs no more. Includes
    // the working space of nodal gradients.
    void lay_out(Arena& arena, Analysis const& analysis, AnyEngine const& engine,
                 Equations& equations, Index columns) noexcept;

    // Refines all functions as far as the engine's factor allows, and fills in residuals,
    // refinements and errors of the report. On Status::cancelled some functions have not been
    // refined to the end.
    Status run(Equations const& equations, AnyEngine& engine, DofValues const& dofs,
               Progress const& progress, SolveReport& report, Fault& fault) noexcept;
    // Residuals of all functions, without refinement.
    void measure(Equations const& equations, DofValues const& dofs,
                 SolveReport& report) const noexcept;
};

// Are residuals and errors within the method's tolerance?
Status judge(SolveReport const& report, Method const& method, Fault& fault) noexcept;

}  // namespace harmorph
