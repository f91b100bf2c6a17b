#include "multigrid/full_approximation.hpp"

#include "multigrid/approximation_cycle.hpp"
#include "multigrid/block_iteration.hpp"

namespace harmorph {

void FullApproximation::lay_out(Arena& arena, Index n, Index functions, Iteration const& asked,
                                Executor const& threads) noexcept {
    Iteration chosen = asked;
    if (chosen.max_iterations == 0) {
        chosen.max_iterations = chosen.merging.max_levels == 1 ? default_steps : default_cycles;
    }
    if (chosen.block_width == 0) chosen.block_width = default_width;
    BlockIteration::lay_out(arena, functions, chosen, threads);
    levels.lay_out(arena, n);
    Offset const cells = n + Agglomeration::coarse_cells(n);
    arena.take(rate_pool, cells);
    arena.take(area_pool, cells);
}

void FullApproximation::use_scheme(Index rows, bool corrected) noexcept {
    scheme_rows = rows;
    stretch = corrected ? 1 : plain_stretch;
}

void FullApproximation::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    volumes.lay_out(arena, n);
    levels.lay_out_work(arena, n, entries);
}

void FullApproximation::lay_out_vectors(Arena& arena, Index n) noexcept {
    arena.take(vectors, workers * worker_rows(n) * iteration.block_width);
}

Status FullApproximation::set_up(SymmetricRows const& finest, Fault& fault) noexcept {
    HARMORPH_TRY(check_diagonals(finest, fault));
    levels.build(finest, iteration.merging);
    measure_work(levels);
    Offset used = 0;
    for (Index l = 0; l < levels.count; ++l) {
        rate[l] = rate_pool.from(used, levels.level[l].n);
        area[l] = area_pool.from(used, levels.level[l].n);
        used += levels.level[l].n;
    }
    copy(area[0], Span<const Real>(volumes.area));
    for (Index l = 0; l + 1 < levels.count; ++l) {
        fill(area[l + 1], 0.0);
        for (Index i = 0; i < levels.level[l].n; ++i)
            area[l + 1][levels.cell_of[l][i]] += area[l][i];
    }
    choose_steps();
    return Status::ok;
}

// Chooses the steps by Gershgorin's theorem: eigenvalues are at most the maximum over the rows of
// |diagonal| + sum of |off-diagonal entries|, and the step of a row follows from the sum of that
// row. Coarse levels have no edge lengths, so only this limit applies to them.
void FullApproximation::choose_steps() noexcept {
    for (Index l = 0; l < levels.count; ++l) {
        SymmetricRows const& rows = levels.level[l];
        copy(rate[l], Span<const Real>(rows.diagonal));
        rows.for_each([&](Index i, Index j, Offset e) {
            rate[l][i] += abs(rows.value[e]);
            rate[l][j] += abs(rows.value[e]);
        });
        for (Real& row_rate : rate[l]) row_rate = damping_limit / row_rate;
    }
    for (Index i = 0; i < rate[0].count(); ++i) {
        Real const half_edge = 0.5 * volumes.shortest_edge[i];
        rate[0][i] = min(stretch * rate[0][i], cfl * half_edge * half_edge / area[0][i]);
    }
}

Status FullApproximation::solve(Rows const& values, const NodalGradient* scheme,
                                Progress const& progress, IterationReport& report,
                                Fault& fault) const noexcept {
    Index const n = levels.level[0].n;
    auto const run = [&](auto width) {
        constexpr Index w = decltype(width)::value;
        auto const solve_block = [&](Index worker, Index first, IterationReport& block_report,
                                     auto const& after) {
            Real* const own_vectors = vectors.data() + worker * worker_rows(n) * w;
            block::FinestScheme<w> const finest{scheme, n, own_vectors + level_rows(n) * w};
            return block::ApproximationCycles<w>(*this, finest, own_vectors, values, first)
                .run(block_report, after);
        };
        return solve_in_blocks(*this, w, values.width, progress, report, fault, solve_block);
    };
    Status const status = with_width(iteration, run);
    report.levels = levels.count;
    return status;
}

}  // namespace harmorph
