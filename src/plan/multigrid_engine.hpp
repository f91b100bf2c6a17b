// The engine multigrid of a plan: conjugate gradients with algebraic multigrid.
// tests/multigrid/test_multigrid.cpp covers this file.
#pragma once

#include "multigrid/multigrid.hpp"
#include "plan/level_engine.hpp"

namespace harmorph {

struct MultigridEngine : LevelEngine<Multigrid> {
    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        iteration.lay_out_levels(arena, analysis.graph().n, analysis.matrix_sizes().entries);
        LevelEngine::lay_out(arena, analysis, columns);
    }
    Status set_up(Equations const& equations, Points, Progress const&, Fault& fault) noexcept {
        Matrix const& matrix = equations.matrix();
        iteration.kernel = equations.method().kernel;
        return iteration.set_up(matrix.rows({}), matrix.imaginary_rows(), fault);
    }
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept {
        return iteration.solve(equations.matrix(), dofs, progress, report, fault);
    }
};

}  // namespace harmorph
