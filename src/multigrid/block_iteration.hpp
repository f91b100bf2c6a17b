// Runs a solver of W functions over all functions, block by block, on as many threads as there are lanes.
#pragma once

#include "harmorph/multigrid/iteration.hpp"
#include "harmorph/base/scalar.hpp"

namespace harmorph {

// solve(lane, first function, report, after) for each block; after(iteration, largest relative residual of the block) is
// told of each iteration, and ends it if it is not ok.
template <class Solve>
Status solve_in_blocks(BlockIteration const& engine, Index functions, Progress const& progress, IterationReport& report,
                       Fault& fault, Solve const& solve) noexcept {
    Index const width = engine.iteration.block_width;
    Index const blocks = (functions + width - 1) / width;
    IterationReport of_lane[Executor::most_threads];
    fill(engine.lane_history, 0.0);
    Status status = Status::ok;
    for (Index first = 0; first < blocks && !failed(status); first += engine.lanes) {
        Index const n = smaller(engine.lanes, blocks - first);
        bool const is_alone = n == 1;  // on the caller's thread, so that the callback may be called
        engine.executor.for_each(n, [&](Index lane) {
            Index const block = first + lane;
            auto const after = [&](Index iteration, Real residual) {
                engine.note(lane, iteration, residual);
                if (!is_alone) return Status::ok;
                Real const part = 1 - 1 / (1 + 0.05 * iteration);  // how many there will be is not known
                return progress.report(Phase::solve, (block + part) / blocks, fault);
            };
            IterationReport its;
            Status const ended = solve(lane, block * width, its, after);
            if (is_alone) status = ended;
            of_lane[lane].iterations = larger(of_lane[lane].iterations, its.iterations);
            of_lane[lane].fine_sweeps = larger(of_lane[lane].fine_sweeps, its.fine_sweeps);
            of_lane[lane].settled = of_lane[lane].settled && its.settled;
        });
        if (failed(status) || first + n >= blocks) break;
        status = progress.report(Phase::solve, static_cast<Real>(first + n) / blocks, fault);
    }
    report = {};
    report.levels = engine.levels.count;
    for (IterationReport const& its : of_lane) {
        report.iterations = larger(report.iterations, its.iterations);
        report.fine_sweeps = larger(report.fine_sweeps, its.fine_sweeps);
        report.settled = report.settled && its.settled;
    }
    engine.tell_history();
    return status;
}

}  // namespace harmorph
