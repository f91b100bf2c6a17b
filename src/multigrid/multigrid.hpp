// Conjugate gradients with a K-cycle over agglomerated levels as preconditioner, and symmetric
// Gauss-Seidel as smoother. Sources: Y. Notay, Electron. Trans. Numer. Anal. 37 (2010) 123
// (aggregation and K-cycle); Y. Notay, P. S. Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473
// (the two inner steps of the K-cycle); Y. Notay, SIAM J. Sci. Comput. 22 (2000) 1444 (flexible
// conjugate gradients).
#pragma once

#include "bspline/envelope_cholesky.hpp"
#include "multigrid/iteration.hpp"

namespace harmorph {

struct Multigrid : BlockIteration {
    static constexpr Index default_iterations = 200;
    // The vectors of a worker; each has block_width numbers for a cell.
    static constexpr Index finest_vectors = 5, coarse_vectors = 4;

    // The Cholesky factor of the coarsest level, if that level is small enough.
    EnvelopeMatrix bottom;
    bool has_bottom = false;

    void lay_out(Arena& arena, Index n, Index functions, Iteration const& asked,
                 Executor const& threads) noexcept;
    // These are the working spaces of set_up() and of solve(); both may occupy the same memory.
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
        levels.lay_out_work(arena, n, entries);
    }
    void lay_out_vectors(Arena& arena, Index n) noexcept;

    // Makes the coarse levels of this matrix. On Status::not_positive, fault.item is a position of
    // the elimination.
    Status set_up(SymmetricRows const& finest, Fault& fault) noexcept;
    // Replaces right-hand sides by solutions in place. The iteration ends when the tolerance or the
    // limit of iterations is reached.
    Status solve(Rows const& values, Progress const& progress, IterationReport& report,
                 Fault& fault) const noexcept;

private:
    static Offset worker_rows(Index n) noexcept {
        return Offset{finest_vectors} * n + coarse_vectors * Agglomeration::coarse_cells(n);
    }
};

}  // namespace harmorph
