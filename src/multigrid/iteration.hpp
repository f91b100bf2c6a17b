// The common members of the iterative engines: options, and blocks of functions.
// tests/multigrid/test_block_rows.cpp and tests/multigrid/test_multigrid.cpp cover this file.
#pragma once

#include "multigrid/agglomeration.hpp"
#include "multigrid/runge_kutta.hpp"
#include "base/executor.hpp"
#include "base/progress.hpp"
#include "base/row_view.hpp"

namespace harmorph {

struct Iteration {
    MergingRules merging;
    // The number of functions that are solved at a time: 4, 8, 16, or 0, the engine's own choice.
    Index block_width = 0;
    Index max_iterations = 0;
    // The full approximation scheme starts from F = 0 instead of full multigrid (FMG).
    bool starts_from_zero = false;
    // The full approximation scheme makes W-cycles with smoothed corrections of optimal length
    // instead of the paper's V-cycles with plain corrections.
    bool has_improved_cycle = false;
    // The tolerance of each function, both for the relative residual in 2-norms, and for the
    // estimated error relative to the largest value.
    Real tolerance = 1e-10;
    // The caller's array, or empty. It receives the largest relative residual before the first
    // iteration and after each iteration.
    Span<Real> history;

    static constexpr bool has_width(Index width) noexcept {
        return width == 4 || width == 8 || width == 16;
    }
};

struct IterationReport {
    Index iterations = 0;  // The largest number of iterations of a function.
    // The largest work for a function, all levels included, in products of the finest level's
    // matrix and a vector divided by `stages`: one step of Runge-Kutta on the finest level is 1.
    Real work = 0;
    Index levels = 0;
    bool settled = true;  // The estimated errors of values are within the tolerance.
};

// Functions are solved in blocks. A worker is one thread's sequence of blocks, with vectors and a
// history of its own.
struct BlockIteration {
    Iteration iteration;
    Executor executor;
    Index workers = 1;
    // The work of a product of a level's matrix and a vector; see IterationReport::work.
    Real product_work[Agglomeration::max_levels];
    Span<Real> vectors;         // [workers x numbers of a worker]
    Span<Real> worker_history;  // [workers x history]

    void lay_out(Arena& arena, Index functions, Iteration const& asked,
                 Executor const& threads) noexcept;
    // Checks that all diagonals are positive; otherwise fault.item is a position of the
    // elimination.
    static Status check_diagonals(SymmetricRows const& rows, Fault& fault) noexcept;
    // Sets the work of a product on each level, of which n(level) and entries(level) are the
    // counts.
    template <class Levels>
    void measure_work(Levels const& levels) noexcept;
    static Status refuse_row(Index position, Fault& fault) noexcept;
    // Records the residual of a block in the worker's history, which has the maximum over all
    // blocks of the worker.
    void note(Index worker, Index number, Real residual) const noexcept;
    // Writes the maximum over all workers to iteration.history.
    void merge_histories() const noexcept;
};

template <class Levels>
void BlockIteration::measure_work(Levels const& levels) noexcept {
    auto const numbers = [&](Index level) {
        return static_cast<Real>(levels.n(level)) + 2 * static_cast<Real>(levels.entries(level));
    };
    for (Index l = 0; l < levels.count; ++l) product_work[l] = numbers(l) / numbers(0) / stages;
}

}  // namespace harmorph
