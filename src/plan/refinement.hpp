// Iterative refinement: residuals of the solved functions, estimates of errors, and corrections.
// tests/plan/test_thin_shear.cpp and tests/plan/test_thin_slip.cpp cover this file.
#pragma once

#include "direct/bicgstab.hpp"
#include "plan/engine.hpp"

namespace harmorph {

struct SolveReport {
    Index unknowns = 0, functions = 0;
    Real residual = 0;
    Index residual_function = none;
    Real missed = 0;  // The largest residual that rounding of accurate values does not explain.
    Index missed_function = none;
    Index refinements = 0;
    Real error = 0;  // The error that the direct engine estimates, relative to the largest value.
    Index error_function = none;
    IterationReport iteration;
    Offset factor_entries = 0;

    // Merges the report of more functions.
    void merge(SolveReport const& others) noexcept;
};

struct Refinement {
    Residual residual;
    // For nodal gradients with an engine that factors.
    BiconjugateGradients biconjugate;

    // Must be called after the engine's lay_out(), as the arrays overlap with working space that
    // the engine no longer needs. The working space of nodal gradients is included.
    void lay_out(Arena& arena, Analysis const& analysis, AnyEngine const& engine,
                 Equations& equations, Index columns) noexcept;

    // Refines all functions as far as the engine's factor allows, and sets residuals, refinements
    // and errors of the report. After Status::cancelled some functions have not been refined to the
    // end.
    Status run(Equations const& equations, AnyEngine& engine, DofValues const& dofs,
               Progress const& progress, SolveReport& report, Fault& fault) noexcept;
    // Computes the residuals of all functions, without refinement.
    void measure(Equations const& equations, DofValues const& dofs,
                 SolveReport& report) const noexcept;
};

// Refuses residuals and errors that are not within the method's tolerance.
Status check_accuracy(SolveReport const& report, Method const& method, Fault& fault) noexcept;

}  // namespace harmorph
