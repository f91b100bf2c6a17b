// Solves all functions block by block, with one thread for each worker.
#pragma once

#include <type_traits>

#include "multigrid/iteration.hpp"
#include "base/scalar.hpp"

namespace harmorph {

// Calls run(integral_constant of the width of a block).
template <class Run>
Status with_width(Iteration const& iteration, Run const& run) noexcept {
    switch (iteration.block_width) {
        case 4: return run(std::integral_constant<Index, 4>{});
        case 8: return run(std::integral_constant<Index, 8>{});
        default: return run(std::integral_constant<Index, 16>{});
    }
}

// Calls solve(worker, first function, report, after) for each block. It must call after(iteration,
// largest relative residual of the block) after each iteration and return the status of this call
// if that is not ok.
template <class Solve>
Status solve_in_blocks(BlockIteration const& engine, Index functions, Progress const& progress,
                       IterationReport& report, Fault& fault, Solve const& solve) noexcept {
    Index const width = engine.iteration.block_width;
    Index const blocks = (functions + width - 1) / width;
    IterationReport of_worker[Executor::max_threads];
    fill(engine.worker_history, 0.0);
    Status status = Status::ok;
    for (Index first = 0; first < blocks && !failed(status); first += engine.workers) {
        Index const n = min(engine.workers, blocks - first);
        bool const is_alone =
            n == 1;  // runs on the caller's thread, so the progress callback may be called
        engine.executor.for_each(n, [&](Index worker) {
            Index const block = first + worker;
            auto const after = [&](Index iteration, Real residual) {
                engine.note(worker, iteration, residual);
                if (!is_alone) return Status::ok;
                Real const part =
                    1 -
                    1 / (1 + 0.05 * iteration);  // the number of iterations is not known in advance
                return progress.report(Phase::solve, (block + part) / blocks, fault);
            };
            IterationReport of_block;
            Status const ended = solve(worker, block * width, of_block, after);
            if (is_alone) status = ended;
            of_worker[worker].iterations = max(of_worker[worker].iterations, of_block.iterations);
            of_worker[worker].fine_sweeps =
                max(of_worker[worker].fine_sweeps, of_block.fine_sweeps);
            of_worker[worker].settled = of_worker[worker].settled && of_block.settled;
        });
        if (failed(status) || first + n >= blocks) break;
        status = progress.report(Phase::solve, static_cast<Real>(first + n) / blocks, fault);
    }
    report = {};
    report.levels = engine.levels.count;
    for (IterationReport const& one : of_worker) {
        report.iterations = max(report.iterations, one.iterations);
        report.fine_sweeps = max(report.fine_sweeps, one.fine_sweeps);
        report.settled = report.settled && one.settled;
    }
    engine.merge_histories();
    return status;
}

}  // namespace harmorph
