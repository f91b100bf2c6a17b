// Solves all functions block by block, with one thread for each worker.
// tests/multigrid/test_multigrid.cpp covers this file.
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
