// The paper's iteration: pseudo-time dF/dt = R(F) by explicit Runge-Kutta steps with local time steps, accelerated by the
// full approximation scheme on agglomerated levels, and started from the coarsest of them (FMG-FAS).
//
// R(F)_P is the flux balance of P's control volume over its area, with the sign that diffuses: R(F)_P = (sum over the
// neighbours Q of c_PQ (F_Q - F_P)) / area_P. Equations 8 and 11 of the paper, as printed, have the opposite sign; F would
// grow without bound.
#pragma once

#include "harmorph/mesh/control_volumes.hpp"
#include "harmorph/multigrid/iteration.hpp"
#include "harmorph/operators/nodal_gradient.hpp"
#include "harmorph/multigrid/runge_kutta.hpp"

namespace harmorph {

struct FullApproximation : BlockIteration {
    static constexpr Index default_cycles = 2000, default_steps = 200000;  // the latter where there is one level
    static constexpr Index finest_vectors = 4, coarse_vectors = 5;         // of a lane, each block_width numbers for each cell
    // dt_P = cfl (0.5 shortest edge)^2, but no longer than what damps all waves of the scheme.
    static constexpr Real cfl = 4;
    // Nodal gradients without correction hardly see short waves: their largest eigenvalues, a quarter of the compact
    // scheme's on squares, were 0.35 of them at most on meshes of all kinds. So steps may be longer. With correction they
    // are those of the compact scheme, within the margin that damping_limit leaves.
    static constexpr Real plain_stretch = 2.5;

    ControlVolumes volumes;                    // of the finest level
    Index scheme_rows = 0;                     // of nodal gradients; 0: the compact scheme
    Real stretch = 1;                          // of steps on the finest level
    Span<Real> rate_pool, area_pool;           // of all levels, one behind the other
    Span<Real> rate[Agglomeration::most_levels];  // [n] dt / area of each cell of a level
    Span<Real> area[Agglomeration::most_levels];  // [n]

    void lay_out(Arena& arena, Index n, Index functions, Iteration const& its_iteration, Executor const& its_executor) noexcept;
    // The finest level's balances will be those of nodal gradients; comes first.
    void take_scheme(Index rows, bool corrected) noexcept;
    // What set_up() needs, and what solve() needs: they may be in one place.
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    void lay_out_vectors(Arena& arena, Index n) noexcept;

    // `volumes` must have been measured.
    Status set_up(SymmetricRows const& finest, Fault& fault) noexcept;
    // In place: right-hand sides become solutions. scheme: whose balances the finest level has, rows by position and then
    // those of known points; null: the compact scheme's. Coarser levels have sums of the compact one's.
    Status solve(Rows const& values, const NodalGradient* scheme, Progress const& progress, IterationReport& report,
                 Fault& fault) const noexcept;

private:
    static Offset level_rows(Index n) noexcept {
        return Offset{finest_vectors} * n + coarse_vectors * Agglomeration::coarse_cells(n);
    }
    Offset lane_rows(Index n) const noexcept { return level_rows(n) + 2 * Offset{scheme_rows}; }
    void choose_steps() noexcept;
};

}  // namespace harmorph
