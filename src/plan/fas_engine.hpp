// The engine fas of a plan: the paper's iteration, for the compact scheme and for nodal gradients.
// tests/multigrid/test_full_approximation.cpp covers this file.
#pragma once

#include "multigrid/full_approximation.hpp"
#include "plan/level_engine.hpp"

namespace harmorph {

struct FasEngine : LevelEngine<FullApproximation> {
    Span<std::uint8_t> faces;  // [entries] Tells which of the matrix's entries are mesh edges.

    void lay_out(Arena& arena, Analysis const& analysis, Index columns) noexcept {
        Method const& method = analysis.problem().method;
        if (method.nodal_gradients()) {
            iteration.use_scheme(analysis.problem().mesh.n_points,
                                 method.scheme == Scheme::nodal_gradient);
        }
        arena.take(faces, analysis.matrix_sizes().entries);
        LevelEngine::lay_out(arena, analysis, columns);
    }
    void take_pattern(Analysis const& analysis, Matrix const& matrix) noexcept {
        matrix.mark_faces(analysis.topology().edges, faces);
    }
    const Agglomeration* levels() const noexcept { return &iteration.levels; }
    Status set_up(Equations const& equations, Points points, Progress const&,
                  Fault& fault) noexcept {
        iteration.volumes.measure(equations.cells(), points, equations.matrix().rows_of_dofs());
        return iteration.set_up(equations.matrix().rows(faces), fault);
    }
    Status solve(Equations const& equations, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) noexcept {
        bool const nodal_gradients = equations.method().nodal_gradients();
        if (nodal_gradients)
            equations.nodal().set_right_hand_sides(dofs, dofs.columns(equations.matrix()));
        NodalGradient const* const scheme = nodal_gradients ? &equations.nodal().scheme : nullptr;
        return iteration.solve(dofs.rows(equations.matrix()), scheme, progress, report, fault);
    }
};

}  // namespace harmorph
