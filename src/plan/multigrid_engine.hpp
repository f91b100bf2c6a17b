// The engine multigrid of a plan: conjugate gradients with algebraic multigrid.
// tests/multigrid/test_multigrid.cpp covers this file.
#pragma once

#include "multigrid/multigrid.hpp"
#include "plan/level_engine.hpp"

namespace harmorph {

struct MultigridEngine : LevelEngine<Multigrid> {
    Status set_up(Equations const& equations, Points, Progress const&, Fault& fault) noexcept {
        Matrix const& matrix = equations.matrix();
        return iteration.set_up(matrix.rows({}), matrix.imaginary_rows(), fault);
    }
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept {
        return iteration.solve(equations.matrix(), dofs, progress, report, fault);
    }
};

}  // namespace harmorph
