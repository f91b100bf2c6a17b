#include "harmorph/multigrid/iteration.hpp"

#include "harmorph/base/scalar.hpp"

namespace harmorph {

void BlockIteration::lay_out(Arena& arena, Index n, Index functions, Iteration const& its_iteration,
                             Executor const& its_executor) noexcept {
    iteration = its_iteration;
    executor = its_executor;
    Index const blocks = (functions + iteration.block_width - 1) / iteration.block_width;
    lanes = executor.is_serial() ? 1 : smaller(executor.n_threads, blocks);
    levels.lay_out(arena, n);
    arena.take(lane_history, Offset{lanes} * iteration.history.count());
}

Status BlockIteration::check_diagonals(SymmetricRows const& rows, Fault& fault) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        if (!(rows.diagonal[i] > 0)) return refuse_row(i, fault);
    }
    return Status::ok;
}

Status BlockIteration::refuse_row(Index position, Fault& fault) noexcept {
    return fault.refuse(Status::not_positive, "the matrix is not positive definite at point #", Counts::mesh, position);
}

void BlockIteration::note(Index lane, Index its_iteration, Real residual) const noexcept {
    Index const length = iteration.history.count();
    if (its_iteration >= length) return;
    Real& its = lane_history[Offset{lane} * length + its_iteration];
    if (exceeds(residual, its)) its = residual;
}

void BlockIteration::tell_history() const noexcept {
    Size const length = iteration.history.size();
    for (Size k = 0; k < length; ++k) {
        Real largest = 0;
        for (Size lane = 0; lane < static_cast<Size>(lanes); ++lane) {
            Real const its = lane_history[lane * length + k];
            if (exceeds(its, largest)) largest = its;
        }
        iteration.history[k] = largest;
    }
}

}  // namespace harmorph
