#include "multigrid/multigrid.hpp"

#include "multigrid/block_iteration.hpp"
#include "multigrid/conjugate_gradients.hpp"

namespace harmorph {

void Multigrid::lay_out(Arena& arena, Index, Index functions, Iteration const& asked,
                        Executor const& threads) noexcept {
    Iteration chosen = asked;
    if (chosen.max_iterations == 0) chosen.max_iterations = default_iterations;
    if (chosen.block_width == 0) chosen.block_width = default_width;
    BlockIteration::lay_out(arena, functions, chosen, threads);
}

void Multigrid::lay_out_levels(Arena& arena, Index n, Offset entries) noexcept {
    levels.lay_out(arena, n, entries);
    bottom.lay_out(arena, CoarsePoints::coarsest, CoarsePoints::coarsest - 1, false);
}

void Multigrid::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    levels.lay_out_work(arena, n, entries);
}

void Multigrid::lay_out_vectors(Arena& arena, Index n) noexcept {
    Offset const numbers = workers * iteration.block_width * worker_numbers(n);
    arena.take(vectors, numbers * Offset{sizeof(float)} / Offset{sizeof(Real)});
}

Status Multigrid::set_up(SymmetricRows const& finest, ImaginaryRows const& imaginary_parts,
                         Fault& fault) noexcept {
    imaginary = imaginary_parts;
    HARMORPH_TRY(check_diagonals(finest, fault));
    levels.build(finest, iteration.merging.max_levels);
    measure_work(levels);
    has_bottom = levels.n(levels.count - 1) <= CoarsePoints::coarsest;
    if (has_bottom && !factor_bottom()) return refuse_row(0, fault);
    is_single = has_bottom && levels.count > 1 && fits_single() &&
                find_disturbance() <= largest_disturbance;
    find_reach();
    if (is_single) round_levels();
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
// 3e38: residuals are scaled to 1, and disturbances are limited, too.
bool Multigrid::fits_single() const noexcept {
    constexpr Real largest = 1e10;
    for (Real const one : levels.finest.diagonal) {
        if (!(one <= largest && one >= 1 / largest)) return false;
    }
    return true;
}

// Returns the energy of a rough vector whose values are about 1, relative to the smallest energy of
// a vector of the coarsest level that has the value 1 at a point. That energy is 1 / the diagonal
// of the inverse of the coarsest matrix.
Real Multigrid::find_disturbance() const noexcept {
    Real rough = 0, softest = 0;
    for (Real const one : levels.finest.diagonal) rough += one;
    Size const n = levels.coarse[levels.count - 1].diagonal.size();
    for (Size point = 0; point < n; ++point) {
        Real column[CoarsePoints::coarsest] = {};
        column[point] = 1;
        bottom.solve({column, n});
        softest = max(softest, column[point]);
    }
    return rough * softest;
}

void Multigrid::find_reach() noexcept {
    for (Index l = 0; l < levels.count; ++l) {
        reach[l] = levels.visit(l, [](auto const& rows) {
            Index farthest = 0;
            for (Index i = 0; i < rows.n; ++i) {
                for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e)
                    farthest = max(farthest, rows.column[e] - i);
            }
            return farthest;
        });
    }
}

// Rounds the numbers of all coarse levels to single precision in place, and stores those of the
// finest level behind them.
void Multigrid::round_levels() noexcept {
    CoarseRows const& last = levels.coarse[levels.count - 1];
    Real* const values = levels.coarse[1].value.data();
    Real* const diagonals = levels.coarse[1].diagonal.data();
    Real* const weights = levels.finer[0].weight.data();
    Offset const entries = last.value.data() - values + last.entries(),
                 points = last.diagonal.data() - diagonals + last.n;
    auto const round = [](const Real* from, Offset n, Real* to, Offset place) {
        char* const bytes = reinterpret_cast<char*>(to) + place * Offset{sizeof(float)};
        for (Offset k = 0; k < n; ++k) {
            float const rounded = static_cast<float>(from[k]);
            std::memcpy(bytes + k * Offset{sizeof(float)}, &rounded, sizeof rounded);
        }
    };
    round(values, entries, values, 0);
    round(diagonals, points, diagonals, 0);
    round(levels.finest.value.data(), levels.finest.entries(), values, entries);
    round(levels.finest.diagonal.data(), levels.finest.n, diagonals, points);
    Index const finer = levels.count - 2;
    Prolongation const& by = levels.finer[finer];
    round(weights, by.weight.data() - weights + by.start[levels.n(finer)], weights, 0);
}

template <>
CycleLevel<double> Multigrid::cycle_level<double>(Index level) const noexcept {
    CycleLevel<double> out;
    levels.visit(level, [&](auto const& rows) {
        out.n = rows.n;
        out.start = rows.start.data();
        out.column = rows.column.data();
        out.value = rows.value.data();
        out.diagonal = rows.diagonal.data();
    });
    out.reach = reach[level];
    if (level + 1 == levels.count) return out;
    Prolongation const& by = levels.finer[level];
    out.n_coarse = levels.n(level + 1);
    out.by_start = by.start.data();
    out.by_column = by.column.data();
    out.by_weight = by.weight.data();
    return out;
}

template <>
CycleLevel<float> Multigrid::cycle_level<float>(Index level) const noexcept {
    CycleLevel<double> const in_double = cycle_level<double>(level);
    auto const rounded = [](const Real* first, Offset place) {
        return reinterpret_cast<const float*>(first) + place;
    };
    CoarseRows const& last = levels.coarse[levels.count - 1];
    const Real* const values = levels.coarse[1].value.data();
    const Real* const diagonals = levels.coarse[1].diagonal.data();
    const Real* const weights = levels.finer[0].weight.data();
    bool const is_finest = level == 0;
    CycleLevel<float> out;
    out.n = in_double.n;
    out.n_coarse = in_double.n_coarse;
    out.reach = in_double.reach;
    out.start = in_double.start;
    out.column = in_double.column;
    out.value = rounded(
        values, is_finest ? last.value.data() - values + last.entries() : in_double.value - values);
    out.diagonal = rounded(diagonals, is_finest ? last.diagonal.data() - diagonals + last.n
                                                : in_double.diagonal - diagonals);
    out.by_start = in_double.by_start;
    out.by_column = in_double.by_column;
    if (out.by_start != nullptr) out.by_weight = rounded(weights, in_double.by_weight - weights);
    return out;
}

Status Multigrid::solve(Matrix const& matrix, DofValues const& dofs, Progress const& progress,
                        IterationReport& report, Fault& fault) const noexcept {
    Status const status = is_single ? solve_with<float>(matrix, dofs, progress, report, fault)
                                    : solve_with<double>(matrix, dofs, progress, report, fault);
    report.levels = levels.count;
    return status;
}

// A block has `block_width` numbers in single precision for each row, or half as many in double
// precision.
template <class Number>
Status Multigrid::solve_with(Matrix const& matrix, DofValues const& dofs, Progress const& progress,
                             IterationReport& report, Fault& fault) const noexcept {
    constexpr Index words = sizeof(Number) / sizeof(float);
    Index const planes = is_complex() ? 2 : 1, width = iteration.block_width / words,
                functions = width / planes, columns = dofs.columns(matrix);
    Offset const worker_reals = Offset{vectors.count()} / workers;
    auto const run_block = [&](Index worker, Index first, IterationReport& block_report,
                               auto const& after) {
        Number* const own = reinterpret_cast<Number*>(vectors.data() + worker * worker_reals);
        // Fewer functions take a narrower block.
        Index own_width = width;
        while (own_width > 4 / words && columns - first <= own_width / planes / 2) own_width /= 2;
        ConjugateGradients<Number> iterate(*this, own_width, own, matrix, dofs, first);
        return iterate.run(block_report, after);
    };
    return solve_in_blocks(*this, functions, columns, progress, report, fault, run_block);
}

}  // namespace harmorph
