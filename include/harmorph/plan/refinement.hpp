// Iterative refinement: what solved functions leave of their equations, what they are thought to be off, and corrections.
#pragma once

#include "harmorph/direct/bicgstab.hpp"
#include "harmorph/plan/engine.hpp"

namespace harmorph {

struct SolveReport {
    Index unknowns = 0, functions = 0;
    Real residual = 0;
    Index residual_function = none;
    Real missed = 0;              // largest residual of those that are more than rounding of values that are right
    Index missed_function = none;
    Index refinements = 0;
    Real error = 0;               // of the direct engine, beside the largest value, as far as it can be told
    Index error_function = none;
    IterationReport iteration;
    Offset factor_entries = 0;
};

struct Refinement {
    Residual residual;
    BiconjugateGradients biconjugate;  // nodal gradients with an engine that factors

    // Behind the engine, in the place of what the engine needs no more; with the working space of nodal gradients.
    void lay_out(Arena& arena, Analysis const& analysis, AnyEngine const& engine, Equations& equations,
                 Index columns) noexcept;

    // Corrects the functions of all lines as far as the engine's factor does, and fills in what the report says of residuals,
    // refinements and errors.
    // On Status::cancelled functions are as good as the refinement came.
    Status run(Equations const& equations, AnyEngine& engine, DofValues const& dofs, Progress const& progress,
               SolveReport& report, Fault& fault) noexcept;
};

// Are residuals and errors within the method's tolerance?
Status judge(SolveReport const& report, Method const& method, Fault& fault) noexcept;

}  // namespace harmorph
