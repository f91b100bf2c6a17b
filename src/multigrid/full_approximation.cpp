#include "multigrid/full_approximation.hpp"

#include <type_traits>

#include "multigrid/block_rows.hpp"
#include "multigrid/iteration.hpp"
#include "operators/nodal_equations.hpp"

namespace harmorph {
namespace block {
namespace {

// The convergence of an iteration for a block of W functions. Each function ends when it has
// converged, when it diverges or at the last cycle, independently of the others. Its values are
// stored at that cycle, so that their bits do not depend on the other functions of the block.
template <Index W>
class BlockConvergence {
public:
    // squares: the squared norm of the right-hand side of each function. Only the first `width`
    // functions of the block exist.
    void begin(Index width, PerFunction<W> const& squares) noexcept {
        width_ = width;
        given_ = squares;
        for (Index k = 0; k < W; ++k) {
            residual_[k] = relative(given_[k], given_[k]);
            smallest_[k] = infinity;
            is_active_[k] = k < width_;
        }
    }

    // squares: the squared norm of the residual of each function after a cycle. changes: the
    // largest change of the values by the cycle, relative to the largest value. Calls store(k) for
    // each function k that ends, and tells whether any function continues.
    template <class Store>
    bool update(Iteration const& iteration, IterationReport& report, PerFunction<W> const& squares,
                PerFunction<W> const& changes, Store const& store) noexcept {
        bool any = false;
        for (Index k = 0; k < width_; ++k) {
            if (!is_active_[k]) continue;
            Real const residual = relative(squares[k], given_[k]);
            bool const settled =
                estimate_error(report.iterations, changes[k], k) <= iteration.tolerance;
            bool const diverges = !(residual <= divergence_ratio * smallest_[k]);
            smallest_[k] = min(smallest_[k], residual);
            residual_[k] = residual;
            is_active_[k] = !(residual <= iteration.tolerance && settled) && !diverges &&
                            report.iterations < iteration.max_iterations;
            any = any || is_active_[k];
            if (is_active_[k]) continue;
            report.settled = report.settled && settled;
            store(k);
        }
        return any;
    }

    // Returns the largest relative residual of all functions.
    Real largest_residual() const noexcept {
        Real largest = 0;
        for (Index k = 0; k < width_; ++k)
            largest = exceeds(residual_[k], largest) ? residual_[k] : largest;
        return largest;
    }

private:
    // The iteration diverges if the residual exceeds the smallest residual so far by this factor.
    static constexpr Real divergence_ratio = 1000;
    // The rate of convergence is measured over so many cycles.
    static constexpr Index rate_cycles = 4;

    // Returns the estimated error. If changes shrink by a constant rate from cycle to cycle, the
    // sum of all future changes is a geometric series. The estimate is at least the last change.
    Real estimate_error(Index iteration, Real change, Index k) noexcept {
        Real& oldest_change = changes_[iteration % rate_cycles][k];
        Real const rate =
            iteration < rate_cycles || oldest_change == 0 ? 1 : sqrt(sqrt(change / oldest_change));
        oldest_change = change;
        if (change == 0) return 0;
        return rate < 1 ? max(rate / (1 - rate), 1.0) * change : infinity;
    }

    static Real relative(Real squares, Real size) noexcept {
        return sqrt(squares) / (size > 0 ? sqrt(size) : 1);
    }

    Index width_ = 0;
    bool is_active_[W] = {};
    PerFunction<W> given_;
    // Relative residuals and the smallest ones so far; a function that has ended keeps its last
    // values.
    PerFunction<W> residual_, smallest_;
    PerFunction<W> changes_[rate_cycles];
};

// Full-approximation cycles for a block of W functions. The paper makes V-cycles, and adds the
// corrections of merged cells to their members as they are. Three measures of the improved cycle
// make the number of cycles nearly independent of the mesh: each level is visited twice from the
// next finer one (W-cycle), as the errors of coarse solutions would add up over the levels; one
// step of Jacobi's method smooths each correction (smoothed aggregation; P. Vanek, J. Mandel, M.
// Brezina, Computing 56 (1996) 179); and the length of each correction minimises the energy of the
// error.

// The scheme of the finest level: nodal gradients, or null, which is the compact scheme.
template <Index W>
struct FinestScheme {
    const NodalGradient* nodal;
    Index n;         // The number of unknowns.
    Real* gradient;  // This array is working space.

    // Adds the balances of u to `rest`.
    void add(const Real* u, Real* rest) const noexcept {
        static constexpr Real zeros[W] = {};
        add_balances(
            *nodal, std::integral_constant<Index, W>{},
            [&](Index row) { return row < n ? u + Offset{row} * W : zeros; },
            {gradient, nodal->inverse_area.size() * 2 * W},
            [&](Index row) { return row < n ? rest + Offset{row} * W : nullptr; });
    }
};

template <Index W>
class ApproximationCycles {
public:
    ApproximationCycles(FullApproximation const& engine, FinestScheme<W> const& finest,
                        Real* vectors, Rows const& values, Index first) noexcept
        : engine_(engine),
          a_(engine.levels),
          finest_(finest),
          values_(values),
          first_(first),
          width_(min(W, values.width - first)) {
        for (Index l = 0; l < a_.count; ++l) {
            Offset const numbers = Offset{a_.level[l].n} * W;
            Vectors& own = at_[l];
            own = {vectors,
                   vectors + numbers,
                   vectors + 2 * numbers,
                   vectors + 3 * numbers,
                   vectors + 4 * numbers,
                   nullptr};
            vectors += 5 * numbers;
            if (l == 0) continue;
            own.restricted = vectors;
            vectors += numbers;
        }
    }

    // Calls after(cycle, largest relative residual of all functions); if it fails, the iteration
    // ends.
    template <class After>
    Status run(IterationReport& report, After const& after) noexcept {
        Index const n = a_.level[0].n;
        for (Index i = 0; i < n; ++i) {
            const Real* const given = values_[i] + first_;
            for (Index k = 0; k < W; ++k) at_[0].f[Offset{i} * W + k] = k < width_ ? given[k] : 0;
        }
        convergence_.begin(width_, dot<W>(at_[0].f, at_[0].f, n));
        HARMORPH_TRY(after(0, convergence_.largest_residual()));
        if (engine_.iteration.starts_from_zero) {
            clear<W>(at_[0].u, n);
        } else {
            start_from_coarsest();
        }
        while (true) {
            take_rest(0);
            bool const any =
                convergence_.update(engine_.iteration, report, dot<W>(at_[0].rest, at_[0].rest, n),
                                    change(), [this](Index k) { store_values(k); });
            if (report.iterations > 0)
                HARMORPH_TRY(after(report.iterations, convergence_.largest_residual()));
            if (!any) break;
            cycle(0, true);
            ++report.iterations;
        }
        report.work = work_;
        return Status::ok;
    }

private:
    // The numbers of steps before and after the coarse correction.
    static constexpr Index finest_steps = 2, coarse_steps = 1, coarsest_steps = 10;
    // The factor by which corrections are smoothed, relative to the step of Runge-Kutta.
    static constexpr Real smoothing = 0.5;
    // The number of cycles on each level on the way from the coarsest to the finest one.
    static constexpr Index starting_cycles = 2;
    struct Vectors {
        Real* f;           // The right-hand side: sums of flux balances.
        Real* u;           // The values.
        Real* start;       // The values at the start of a step.
        Real* rest;        // The residual f - A u.
        Real* product;     // The product of A and a correction.
        Real* restricted;  // The values from the finer level.
    };

    void store_values(Index k) const noexcept {
        for (Index i = 0; i < a_.level[0].n; ++i)
            values_[i][first_ + k] = at_[0].u[Offset{i} * W + k];
    }

    // Returns an upper bound of the change of values by the last coarse correction and by one step
    // from the current values, relative to the largest value. Thin cells have by far the largest
    // flux balances, so elsewhere a small residual may hide a large error.
    PerFunction<W> change() const noexcept {
        PerFunction<W> bound;
        for (Index i = 0; i < a_.level[0].n; ++i) {
            const Real* const rest = at_[0].rest + Offset{i} * W;
            for (Index k = 0; k < W; ++k)
                bound[k] = max(bound[k], engine_.rate[0][i] * abs(rest[k]));
        }
        PerFunction<W> const size = largest<W>(at_[0].u, a_.level[0].n);
        for (Index k = 0; k < W; ++k)
            bound[k] = size[k] > 0 ? (bound[k] + corrected_[k]) / size[k] : 0;
        return bound;
    }

    void count_products(Index level, Index n) noexcept { work_ += n * engine_.product_work[level]; }

    void take_rest(Index level) noexcept {
        Vectors const& own = at_[level];
        count_products(level, 1);
        if (level > 0 || finest_.nodal == nullptr)
            return residual<W>(a_.level[level], own.f, own.u, own.rest);
        copy<W>(own.f, own.rest, a_.level[0].n);
        finest_.add(own.u, own.rest);
    }

    // Makes one Runge-Kutta step in pseudo-time. has_rest tells whether the residual of u has been
    // computed.
    void step(Index level, bool has_rest) noexcept {
        Vectors const& own = at_[level];
        Index const n = a_.level[level].n;
        copy<W>(own.u, own.start, n);
        for (Index stage = 0; stage < stages; ++stage) {
            if (stage > 0 || !has_rest) take_rest(level);
            for (Index i = 0; i < n; ++i) {
                Real const by = stage_coefficient[stage] * engine_.rate[level][i];
                Offset const row = Offset{i} * W;
                for (Index k = 0; k < W; ++k)
                    own.u[row + k] = own.start[row + k] + by * own.rest[row + k];
            }
        }
    }
    void steps(Index level, Index n, bool has_rest) noexcept {
        for (Index k = 0; k < n; ++k) step(level, has_rest && k == 0);
    }

    void cycle(Index level, bool has_rest) noexcept {
        if (level + 1 >= a_.count) return steps(level, level > 0 ? coarsest_steps : 1, has_rest);
        Index const n = level == 0 ? finest_steps : coarse_steps;
        steps(level, n, has_rest);
        restrict_to_coarse(level);
        bool const coarsest_is_next = level + 2 == a_.count;
        Index const visits = engine_.iteration.has_improved_cycle && !coarsest_is_next ? 2 : 1;
        for (Index k = 0; k < visits; ++k) cycle(level + 1, false);
        correct(level);
        steps(level, n, false);
    }

    // Restricts values by area-weighted means, and flux balances by sums. The right-hand side of
    // the coarse equations is the coarse operator applied to the restricted values, plus the
    // restricted balances (full approximation scheme).
    void restrict_to_coarse(Index level) noexcept {
        Index const below = level + 1, n = a_.level[below].n;
        Vectors const& coarse = at_[below];
        Span<const Index> const cell_of = a_.cell_of[level];
        take_rest(level);
        clear<W>(coarse.u, n);
        clear<W>(coarse.rest, n);
        for (Index i = 0; i < cell_of.count(); ++i) {
            Offset const cell = Offset{cell_of[i]} * W;
            add<W>(engine_.area[level][i], at_[level].u + Offset{i} * W, coarse.u + cell);
            add<W>(1.0, at_[level].rest + Offset{i} * W, coarse.rest + cell);
        }
        for (Index i = 0; i < n; ++i) {
            for (Index k = 0; k < W; ++k) coarse.u[Offset{i} * W + k] /= engine_.area[below][i];
        }
        copy<W>(coarse.u, coarse.restricted, n);
        multiply<W>(a_.level[below], coarse.u, coarse.f);
        count_products(below, 1);
        for (Offset k = 0; k < Offset{n} * W; ++k) coarse.f[k] += coarse.rest[k];
    }

    // Prolongation: u += P (change of the coarse values), where P copies the value of a merged cell
    // to its members. The improved cycle has length * S P instead of P. S is a step of Jacobi's
    // method; the length minimises the energy of the error on this level (A. Reusken, Numer. Math.
    // 58 (1991) 819): corrections from merged cells are too small in smooth regions and too large
    // elsewhere.
    void correct(Index level) noexcept {
        Vectors const& own = at_[level];
        Vectors const& coarse = at_[level + 1];
        Span<const Index> const cell_of = a_.cell_of[level];
        Index const n = cell_of.count();
        Real* const change = own.start;
        for (Index i = 0; i < n; ++i) {
            Offset const cell = Offset{cell_of[i]} * W;
            for (Index k = 0; k < W; ++k)
                change[Offset{i} * W + k] = coarse.u[cell + k] - coarse.restricted[cell + k];
        }
        PerFunction<W> length;
        for (Index k = 0; k < W; ++k) length[k] = 1;
        if (engine_.iteration.has_improved_cycle) length = smooth(level, change);
        if (level == 0) {
            corrected_ = largest<W>(change, n);
            for (Index k = 0; k < W; ++k) corrected_[k] *= abs(length[k]);
        }
        add_multiple<W>(length, change, own.u, n);
    }

    // Makes a step of Jacobi's method and returns the lengths that minimise the energy of the
    // error.
    PerFunction<W> smooth(Index level, Real* change) noexcept {
        Vectors const& own = at_[level];
        Index const n = a_.level[level].n;
        multiply<W>(a_.level[level], change, own.product);
        for (Index i = 0; i < n; ++i)
            add<W>(-smoothing * engine_.rate[level][i], own.product + Offset{i} * W,
                   change + Offset{i} * W);
        PerFunction<W> length = dot<W>(change, own.rest, n);
        PerFunction<W> const along = energy<W>(a_.level[level], change);
        count_products(level, 2);
        for (Index k = 0; k < W; ++k) length[k] = along[k] > 0 ? length[k] / along[k] : 0;
        return length;
    }

    // FMG-FAS solves the problem on the coarsest level; the solution is the start on the next finer
    // level, and so on.
    void start_from_coarsest() noexcept {
        for (Index l = 0; l + 1 < a_.count; ++l) {
            Index const n = a_.level[l + 1].n;
            clear<W>(at_[l + 1].f, n);
            for (Index i = 0; i < a_.level[l].n; ++i) {
                add<W>(1.0, at_[l].f + Offset{i} * W, at_[l + 1].f + Offset{a_.cell_of[l][i]} * W);
            }
        }
        Index const last = a_.count - 1;
        clear<W>(at_[last].u, a_.level[last].n);
        for (Index l = last; l > 0; --l) {
            for (Index k = 0; k < starting_cycles; ++k) cycle(l, false);
            for (Index i = 0; i < a_.level[l - 1].n; ++i) {
                Lanes<W, Real>(at_[l].u + Offset{a_.cell_of[l - 1][i]} * W)
                    .store(at_[l - 1].u + Offset{i} * W);
            }
        }
    }

    FullApproximation const& engine_;
    Agglomeration const& a_;
    FinestScheme<W> finest_;
    Rows const& values_;
    Index first_, width_;
    Real work_ = 0;  // See IterationReport::work.
    BlockConvergence<W> convergence_;
    PerFunction<W> corrected_;  // The largest change by the last correction on the finest level.
    Vectors at_[Agglomeration::max_levels];
};

}  // namespace
}  // namespace block

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
