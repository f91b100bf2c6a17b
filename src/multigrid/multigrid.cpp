#include "multigrid/multigrid.hpp"

#include "multigrid/block_iteration.hpp"
#include "multigrid/multigrid_cycle.hpp"

namespace harmorph {

void Multigrid::lay_out(Arena& arena, Index n, Index functions, Iteration const& asked,
                        Executor const& threads) noexcept {
    Iteration chosen = asked;
    if (chosen.max_iterations == 0) chosen.max_iterations = default_iterations;
    if (chosen.block_width == 0) chosen.block_width = default_width;
    BlockIteration::lay_out(arena, functions, chosen, threads);
    levels.lay_out(arena, n);
    bottom.lay_out(arena, CoarsePoints::coarsest, CoarsePoints::coarsest - 1, false);
}

void Multigrid::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    Size const shared = arena.mark();
    levels.lay_out_work(arena, n, entries);
    arena.release(shared);
    arena.take(loads_, n + CoarsePoints::coarse_points(n));
}

template <class Number>
Offset Multigrid::worker_bytes(Index n, Index width) noexcept {
    Offset const reals = Offset{double_vectors} * n;
    Offset const numbers = Offset{preconditioner_vectors} * n + CoarsePoints::coarse_points(n);
    return width * (reals * Offset{sizeof(Real)} + numbers * Offset{sizeof(Number)});
}

Offset Multigrid::worker_reals(Index n) const noexcept {
    Index const width = iteration.block_width;
    Offset const bytes = max(worker_bytes<float>(n, width), worker_bytes<Real>(n, width / 2));
    return (bytes + Offset{sizeof(Real)} - 1) / Offset{sizeof(Real)};
}

void Multigrid::lay_out_vectors(Arena& arena, Index n) noexcept {
    arena.take(vectors, workers * worker_reals(n));
}

Status Multigrid::set_up(SymmetricRows const& finest, ImaginaryRows const& imaginary_parts,
                         Fault& fault) noexcept {
    imaginary = imaginary_parts;
    HARMORPH_TRY(check_diagonals(finest, fault));
    levels.build(finest, iteration.merging.max_levels);
    measure_work(levels);
    has_bottom = levels.n(levels.count - 1) <= CoarsePoints::coarsest;
    if (has_bottom && !factor_bottom()) return refuse_row(0, fault);
    is_single = has_bottom && fits_single() && estimate_condition() <= largest_single_condition;
    return Status::ok;
}

bool Multigrid::factor_bottom() noexcept {
    return levels.visit(levels.count - 1, [&](auto const& last) {
        bottom.shape(last.n, last.n - 1, false);
        for (Index i = 0; i < last.n; ++i) {
            bottom.at(i, i) = last.diagonal[i];
            for (Offset e = last.start[i]; e < last.start[i + 1]; ++e)
                bottom.add(i, last.column[e], last.value[e]);
        }
        return bottom.factor() == none;
    });
}

// Returns whether no product of the preconditioner leaves the range of single precision, 1e-38 ..
// 3e38: residuals are scaled to 1, and the condition number is at most largest_single_condition.
bool Multigrid::fits_single() const noexcept {
    constexpr Real largest = 1e10;
    for (Real const one : levels.finest.diagonal) {
        if (!(one <= largest && one >= 1 / largest)) return false;
    }
    return true;
}

// Returns an estimate of 1 / the smallest eigenvalue of D^-1 A: (d.A^-1 d) / (1.d), where d is the
// diagonal, and the coarsest level stands for A^-1.
Real Multigrid::estimate_condition() noexcept {
    Span<Real> load = loads_.first(levels.finest.n);
    copy(load, Span<const Real>(levels.finest.diagonal));
    Real sum = 0;
    for (Real const one : load) sum += one;
    Offset used = 0;
    for (Index l = 0; l + 1 < levels.count; ++l) {
        Span<Real> const finer = load;
        used += levels.n(l);
        load = loads_.from(used, levels.n(l + 1));
        fill(load, 0.0);
        Prolongation const& by = levels.finer[l];
        for (Index i = 0; i < levels.n(l); ++i) {
            for (Offset e = by.start[i]; e < by.start[i + 1]; ++e)
                load[by.column[e]] += by.weight[e] * finer[i];
        }
    }
    Real solution[CoarsePoints::coarsest], energy = 0;
    copy(Span<Real>(solution, load.size()), Span<const Real>(load));
    bottom.solve({solution, load.size()});
    for (Size i = 0; i < load.size(); ++i) energy += solution[i] * load[i];
    return energy / sum;
}

Status Multigrid::solve(Matrix const& matrix, DofValues const& dofs, Progress const& progress,
                        IterationReport& report, Fault& fault) const noexcept {
    Index const n = levels.finest.n;
    auto const run = [&](auto width, auto zero) {
        constexpr Index w = decltype(width)::value;
        auto const run_block = [&](Index worker, Index first, IterationReport& block_report,
                                   auto const& after) {
            Real* const own_vectors = vectors.data() + worker * worker_reals(n);
            block::ConjugateGradients<w, decltype(zero)> iterate(*this, own_vectors, matrix, dofs,
                                                                 first);
            return iterate.run(block_report, after);
        };
        Index const functions = is_complex() ? w / 2 : w;
        return solve_in_blocks(*this, functions, dofs.columns(matrix), progress, report, fault,
                               run_block);
    };
    Status const status = with_width(iteration, [&](auto width) {
        constexpr Index half = decltype(width)::value / 2;
        return is_single ? run(width, float{}) : run(std::integral_constant<Index, half>{}, Real{});
    });
    report.levels = levels.count;
    return status;
}

}  // namespace harmorph
