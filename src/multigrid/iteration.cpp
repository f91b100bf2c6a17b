#include "multigrid/iteration.hpp"

#include "base/scalar.hpp"

namespace harmorph {

void BlockIteration::lay_out(Arena& arena, Index functions, Iteration const& asked,
                             Executor const& threads) noexcept {
    iteration = asked;
    executor = threads;
    Index const blocks = (functions + iteration.block_width - 1) / iteration.block_width;
    workers = executor.is_serial() ? 1 : min(executor.n_threads, blocks);
    arena.take(worker_history, Offset{workers} * iteration.history.count());
}

Status BlockIteration::check_diagonals(SymmetricRows const& rows, Fault& fault) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        if (!(rows.diagonal[i] > 0)) return refuse_row(i, fault);
    }
    return Status::ok;
}

Status BlockIteration::refuse_row(Index position, Fault& fault) noexcept {
    return fault.refuse(Status::not_positive,
                        "the matrix of the equations is not positive definite at point #",
                        point_item(position));
}

void BlockIteration::note(Index worker, Index number, Real residual) const noexcept {
    Index const length = iteration.history.count();
    if (number >= length) return;
    Real& largest = worker_history[Offset{worker} * length + number];
    if (exceeds(residual, largest)) largest = residual;
}

void BlockIteration::merge_histories() const noexcept {
    Size const length = iteration.history.size();
    for (Size k = 0; k < length; ++k) {
        Real largest = 0;
        for (Size worker = 0; worker < static_cast<Size>(workers); ++worker) {
            Real const residual = worker_history[worker * length + k];
            if (exceeds(residual, largest)) largest = residual;
        }
        iteration.history[k] = largest;
    }
}

}  // namespace harmorph
