// Conjugate gradients with a cycle of algebraic multigrid as preconditioner, and symmetric
// Gauss-Seidel as smoother. Sources: J. W. Ruge, K. Stueben, Algebraic multigrid (1987); Y. Notay,
// SIAM J. Sci. Comput. 22 (2000) 1444 (flexible conjugate gradients).
#pragma once

#include "bspline/envelope_cholesky.hpp"
#include "multigrid/coarse_points.hpp"
#include "multigrid/cycle_table.hpp"
#include "multigrid/iteration.hpp"
#include "operators/residual.hpp"

namespace harmorph {

// All vectors are in single precision but for the solutions, which are corrected in double
// precision; residuals are computed in double precision from time to time. Rounding to single
// precision disturbs smooth vectors by rough ones of relative size 6e-8. In thin cells, and where
// weights differ by many orders of magnitude, the energy of a rough vector may be so much larger
// that the disturbance has more energy than the vector. All vectors are then in double precision,
// with half as many functions at a time, so that they fit into the same memory.
//
// If the matrix is Hermitian, the levels are those of its real part, which is positive definite,
// too: x.Re(A) x = x.A x for a real vector x. The preconditioner treats the real and the imaginary
// parts of half as many functions as so many real vectors.
struct Multigrid : BlockIteration {
    static constexpr Index default_iterations = 200, default_width = 8;
    // See find_disturbance(). In trials, single precision took at most one iteration more than
    // double precision up to 1e10, and up to five more, of 16, from there to 2e11.
    static constexpr Real largest_disturbance = 1e10;

    CoarsePoints levels;
    ImaginaryRows imaginary;
    // The Cholesky factor of the coarsest level, if that level is small enough.
    EnvelopeMatrix bottom;
    bool has_bottom = false;
    bool is_single = false;
    Kernel kernel = Kernel::baseline;  // All kernels give the same bits.
    Index reach[CoarsePoints::max_levels];

    void lay_out(Arena& arena, Index n, Index functions, Iteration const& asked,
                 Executor const& threads) noexcept;
    // entries: the number of entries of the matrix.
    void lay_out_levels(Arena& arena, Index n, Offset entries) noexcept;
    // The working spaces of set_up() and of solve(); both may occupy the same memory.
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    void lay_out_vectors(Arena& arena, Index n) noexcept;

    // Makes the coarse levels of this matrix. On Status::not_positive, fault.item is a position of
    // the elimination.
    Status set_up(SymmetricRows const& finest, ImaginaryRows const& imaginary_parts,
                  Fault& fault) noexcept;
    bool is_complex() const noexcept { return !imaginary.value.empty(); }
    // Replaces right-hand sides, or first approximations (DofValues::is_start), by solutions in
    // place. The iteration ends when the tolerance or the limit of iterations is reached.
    Status solve(Matrix const& matrix, DofValues const& dofs, Progress const& progress,
                 IterationReport& report, Fault& fault) const noexcept;

    // Returns the level in the precision that set_up() has chosen.
    template <class Number>
    CycleLevel<Number> cycle_level(Index level) const noexcept;

private:
    // The vectors of the finest level. Vectors of coarse levels share the room of Cycle's vectors.
    static constexpr Index finest_vectors = 4;
    // Returns the number of numbers in single precision that a worker needs for each function.
    static Offset worker_numbers(Index n) noexcept {
        return Offset{finest_vectors} * n + CoarsePoints::coarse_points(n);
    }
    template <class Number>
    Status solve_with(Matrix const& matrix, DofValues const& dofs, Progress const& progress,
                      IterationReport& report, Fault& fault) const noexcept;
    bool factor_bottom() noexcept;
    bool fits_single() const noexcept;
    Real find_disturbance() const noexcept;
    void find_reach() noexcept;
    void round_levels() noexcept;
};

}  // namespace harmorph
