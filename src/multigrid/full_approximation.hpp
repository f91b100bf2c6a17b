// The paper's iteration: pseudo-time dF/dt = R(F) by explicit Runge-Kutta steps with local time
// steps, accelerated by the full approximation scheme on agglomerated levels, and started from the
// coarsest level (FMG-FAS).
//
// R(F)_P is the flux balance of the control volume of P divided by the area of the volume, with the
// sign of diffusion: R(F)_P = (sum over the neighbours Q of c_PQ (F_Q - F_P)) / area_P. Equations 8
// and 11 of the paper are printed with the opposite sign, with which F would grow without bound.
#pragma once

#include "mesh/median_dual.hpp"
#include "multigrid/iteration.hpp"
#include "operators/nodal_equations.hpp"

namespace harmorph {

struct FullApproximation : BlockIteration {
    // The default number of cycles, or of steps if there is a single level.
    static constexpr Index default_cycles = 2000, default_steps = 200000, default_width = 8;
    // The vectors of a worker; each has block_width numbers for a cell.
    static constexpr Index finest_vectors = 5, coarse_vectors = 6;
    // The time step is dt_P = cfl (0.5 shortest edge)^2, but at most the step with which the scheme
    // damps all eigenvectors.
    static constexpr Real cfl = 4;
    // Nodal gradients without correction have small eigenvalues for short waves: the largest
    // eigenvalue is a quarter of the compact scheme's on squares, and was measured to be at most
    // 0.35 of the compact scheme's on meshes of all kinds. Therefore steps may be 2.5 times as
    // long. With correction both schemes have the same largest eigenvalues, within the margin that
    // damping_limit leaves.
    static constexpr Real plain_stretch = 2.5;

    Agglomeration levels;
    ControlVolumes volumes;  // The control volumes of the finest level.
    // The rows of the scheme of nodal gradients; 0 means the compact scheme.
    Index scheme_rows = 0;
    Real stretch = 1;                            // The factor of the steps on the finest level.
    Span<Real> rate_pool, area_pool;             // The levels follow each other in these arrays.
    Span<Real> rate[Agglomeration::max_levels];  // [n] dt / area of each cell of a level.
    Span<Real> area[Agglomeration::max_levels];  // [n]

    void lay_out(Arena& arena, Index n, Index functions, Iteration const& asked,
                 Executor const& threads) noexcept;
    // Selects nodal gradients for the balances on the finest level; to be called before
    // lay_out().
    void use_scheme(Index rows, bool corrected) noexcept;
    // The working spaces of set_up() and of solve(); both may occupy the same memory.
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    void lay_out_vectors(Arena& arena, Index n) noexcept;

    // `volumes` must have been measured.
    Status set_up(SymmetricRows const& finest, Fault& fault) noexcept;
    // Replaces right-hand sides by solutions in place. `scheme` has the nodal gradients for the
    // finest level, with rows of unknowns by position and then rows of known points; null means the
    // compact scheme. Coarser levels have sums of the compact scheme's conductances.
    Status solve(Rows const& values, const NodalGradient* scheme, Progress const& progress,
                 IterationReport& report, Fault& fault) const noexcept;

private:
    static Offset level_rows(Index n) noexcept {
        return Offset{finest_vectors} * n + coarse_vectors * Agglomeration::coarse_cells(n);
    }
    Offset worker_rows(Index n) const noexcept { return level_rows(n) + 2 * Offset{scheme_rows}; }
    void choose_steps() noexcept;
};

}  // namespace harmorph
