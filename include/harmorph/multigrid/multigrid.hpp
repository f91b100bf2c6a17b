// Conjugate gradients, preconditioned by a K-cycle over agglomerated levels with symmetric Gauss-Seidel. Sources: Y. Notay,
// Electron. Trans. Numer. Anal. 37 (2010) 123 (aggregation and K-cycle); Y. Notay, P. S. Vassilevski, Numer. Linear Algebra
// Appl. 15 (2008) 473 (its two inner steps); Y. Notay, SIAM J. Sci. Comput. 22 (2000) 1444 (flexible conjugate gradients).
#pragma once

#include "harmorph/bspline/envelope_cholesky.hpp"
#include "harmorph/multigrid/iteration.hpp"

namespace harmorph {

struct Multigrid : BlockIteration {
    static constexpr Index default_iterations = 200;
    static constexpr Index finest_vectors = 5, coarse_vectors = 4;  // of a lane, each block_width numbers for each cell

    EnvelopeMatrix bottom;    // factor of the coarsest level, if that is small
    bool has_bottom = false;

    void lay_out(Arena& arena, Index n, Index functions, Iteration const& its_iteration, Executor const& its_executor) noexcept;
    // What set_up() needs, and what solve() needs: they may be in one place.
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept { levels.lay_out_work(arena, n, entries); }
    void lay_out_vectors(Arena& arena, Index n) noexcept;

    // Levels and sums for the rows as they are now. On Status::not_positive, fault.item is a position.
    Status set_up(SymmetricRows const& finest, Fault& fault) noexcept;
    // In place: right-hand sides become solutions. Ends at the tolerance or at the limit of iterations, whichever is first.
    Status solve(Rows const& values, Progress const& progress, IterationReport& report, Fault& fault) const noexcept;

private:
    static Offset lane_rows(Index n) noexcept {
        return Offset{finest_vectors} * n + coarse_vectors * Agglomeration::coarse_cells(n);
    }
};

}  // namespace harmorph
