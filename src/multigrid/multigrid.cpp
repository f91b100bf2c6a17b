#include "multigrid/multigrid.hpp"

#include "multigrid/block_iteration.hpp"
#include "multigrid/multigrid_cycle.hpp"

namespace harmorph {

void Multigrid::lay_out(Arena& arena, Index n, Index functions, Iteration const& asked,
                        Executor const& threads) noexcept {
    Iteration chosen = asked;
    if (chosen.max_iterations == 0) chosen.max_iterations = default_iterations;
    BlockIteration::lay_out(arena, n, functions, chosen, threads);
    bottom.lay_out(arena, Agglomeration::coarsest, Agglomeration::coarsest - 1, false);
}

void Multigrid::lay_out_vectors(Arena& arena, Index n) noexcept {
    arena.take(vectors, workers * worker_rows(n) * iteration.block_width);
}

Status Multigrid::set_up(SymmetricRows const& finest, Fault& fault) noexcept {
    HARMORPH_TRY(check_diagonals(finest, fault));
    merge(finest);
    SymmetricRows const& last = levels.level[levels.count - 1];
    has_bottom = last.n <= Agglomeration::coarsest;
    if (!has_bottom) return Status::ok;
    bottom.shape(last.n, last.n - 1, false);
    for (Index i = 0; i < last.n; ++i) bottom.at(i, i) = last.diagonal[i];
    last.for_each([&](Index i, Index j, Offset e) { bottom.add(i, j, last.value[e]); });
    return bottom.factor() == none ? Status::ok : refuse_row(0, fault);
}

Status Multigrid::solve(Rows const& values, Progress const& progress, IterationReport& report,
                        Fault& fault) const noexcept {
    Index const n = levels.level[0].n;
    auto const run = [&](auto width) {
        constexpr Index w = decltype(width)::value;
        auto const run_block = [&](Index worker, Index first, IterationReport& block_report,
                                   auto const& after) {
            Real* const own_vectors = vectors.data() + worker * worker_rows(n) * w;
            block::ConjugateGradients<w> iterate(*this, own_vectors, values, first);
            return iterate.run(block_report, after);
        };
        return solve_in_blocks(*this, values.width, progress, report, fault, run_block);
    };
    return with_width(iteration, run);
}

}  // namespace harmorph
