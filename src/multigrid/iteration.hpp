// The common members of the iterative engines: options, and blocks of functions.
// tests/multigrid/test_block_rows.cpp and tests/multigrid/test_multigrid.cpp cover this file.
#pragma once

#include <type_traits>

#include "base/executor.hpp"
#include "base/scalar.hpp"
#include "base/span.hpp"
#include "base/types.hpp"
#include "multigrid/agglomeration.hpp"

namespace harmorph {

// The explicit four-stage Runge-Kutta scheme of the paper's iteration, dF/dt = R(F): F(k) = F(0) +
// alpha_k dt R(F(k-1)), k = 1 .. 4, and F(4) is the new F.

// The coefficients are usual in agglomeration multigrid of second order (M.-H. Lallemand, Etude de
// schemas Runge-Kutta a 4 pas pour la resolution multigrille des equations d'Euler 2D, INRIA 1988,
// as quoted by others). alpha_4 = 1 and alpha_3 = 1/2 give the order; the others were chosen for
// damping.
inline constexpr Index stages = 4;
inline constexpr Real stage_coefficient[stages] = {0.11, 0.2766, 0.5, 1.0};

// For R = -lambda F one step multiplies F by g(lambda dt), g(x) = 1 - x + x^2 / 2 - 0.1383 x^3 +
// 0.01521 x^4. |g| < 1 for x below 5.2. Below damping_limit, which the library chooses, |g| is at
// most 1/2 from x = 0.7 on, so that the largest eigenvalues are damped, too.
inline constexpr Real damping_limit = 4.3;

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
    // The caller's array, or empty; receives the largest relative residual before the first
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

// Solves all functions block by block, with one thread for each worker.

// Calls run(integral_constant of the width of a block).
template <class Run>
Status with_width(Iteration const& iteration, Run const& run) noexcept {
    switch (iteration.block_width) {
        case 4: return run(std::integral_constant<Index, 4>{});
        case 8: return run(std::integral_constant<Index, 8>{});
        default: return run(std::integral_constant<Index, 16>{});
    }
}

// Calls solve(worker, first function, report, after) for each block of `width` functions. `solve`
// must call after(iteration, largest relative residual of the block) after each iteration, and
// return the status of this call if that is not ok.
template <class Solve>
Status solve_in_blocks(BlockIteration const& engine, Index width, Index functions,
                       Progress const& progress, IterationReport& report, Fault& fault,
                       Solve const& solve) noexcept {
    Index const blocks = (functions + width - 1) / width;
    IterationReport worker_report[Executor::max_threads];
    fill(engine.worker_history, 0.0);
    Status status = Status::ok;
    for (Index first = 0; first < blocks && !failed(status); first += engine.workers) {
        Index const n = min(engine.workers, blocks - first);
        // A single block runs on the caller's thread, so the progress callback may be called.
        bool const is_alone = n == 1;
        engine.executor.for_each(n, [&](Index worker) {
            Index const block = first + worker;
            auto const after = [&](Index iteration, Real residual) {
                engine.note(worker, iteration, residual);
                if (!is_alone) return Status::ok;
                // The number of iterations is not known in advance, so this is only an estimate of
                // the progress.
                Real const fraction = 1 - 1 / (1 + 0.05 * iteration);
                return progress.report(Phase::solve, (block + fraction) / blocks, fault);
            };
            IterationReport block_report;
            Status const ended = solve(worker, block * width, block_report, after);
            if (is_alone) status = ended;
            worker_report[worker].iterations =
                max(worker_report[worker].iterations, block_report.iterations);
            worker_report[worker].work = max(worker_report[worker].work, block_report.work);
            worker_report[worker].settled = worker_report[worker].settled && block_report.settled;
        });
        if (failed(status) || first + n >= blocks) break;
        status = progress.report(Phase::solve, static_cast<Real>(first + n) / blocks, fault);
    }
    report = {};
    for (IterationReport const& one : worker_report) {
        report.iterations = max(report.iterations, one.iterations);
        report.work = max(report.work, one.work);
        report.settled = report.settled && one.settled;
    }
    engine.merge_histories();
    return status;
}

}  // namespace harmorph
