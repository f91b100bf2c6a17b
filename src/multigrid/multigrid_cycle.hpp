// The K-cycle for a block of W functions, and the conjugate gradients that it preconditions.
// tests/multigrid/test_multigrid.cpp covers this file.
#pragma once

#include "multigrid/block_rows.hpp"
#include "multigrid/multigrid.hpp"

namespace harmorph::block {

// Returns the step along a direction, or 0 if the direction has no energy, or so little that the
// quotient would overflow.
inline Real per_energy(Real product, Real energy) noexcept {
    constexpr Real smallest = 1e-150;
    return energy > 0 && smallest * abs(product) <= energy ? product / energy : 0;
}

template <Index W>
class Cycle {
public:
    Cycle(Multigrid const& engine, Real* vectors) noexcept : engine_(engine), a_(engine.levels) {
        Index const n = a_.level[0].n;
        for (Index k = 0; k < Multigrid::finest_vectors; ++k, vectors += Offset{n} * W)
            finest[k] = vectors;
        for (Index l = 1; l < a_.count; ++l) {
            for (Index k = 0; k < Multigrid::coarse_vectors;
                 ++k, vectors += Offset{a_.level[l].n} * W) {
                coarse_[l][k] = vectors;
            }
        }
    }

    Real* finest[Multigrid::finest_vectors];

    // Computes z = B r, where B approximates the inverse. B is positive definite, but depends
    // weakly on r through the inner steps of the cycle, so the conjugate gradients must be
    // flexible.
    void precondition(const Real* r, Real* z) noexcept { precondition(0, r, z); }

    // Returns the work of all calls so far, see IterationReport::work.
    Real work() const noexcept { return work_; }
    void count_products(Index level, Index n) noexcept { work_ += n * engine_.product_work[level]; }

private:
    bool is_last(Index level) const noexcept { return level + 1 == a_.count; }

    void precondition(Index level, const Real* r, Real* z) noexcept {
        SymmetricRows const& rows = a_.level[level];
        copy<W>(r, z, rows.n);
        if (is_last(level) && engine_.has_bottom) return solve_bottom(z);
        forward<W>(rows, z);
        // Each of the four passes goes through one triangle of the matrix.
        count_products(level, is_last(level) ? 1 : 2);
        if (is_last(level)) {
            scale_by_diagonal<W>(rows, z);
        } else {
            Index const below = level + 1;
            to_defect<W>(rows, a_.cell_of[level], a_.level[below].n, z, coarse_[below][0]);
            solve(below);
            correct<W>(rows, a_.cell_of[level], coarse_[below][1], z);
        }
        backward<W>(rows, z);
    }

    // Makes two steps of flexible conjugate gradients from 0, each preconditioned by the coarser
    // levels (K-cycle).
    void solve(Index level) noexcept {
        SymmetricRows const& rows = a_.level[level];
        Real* const r = coarse_[level][0];
        Real* const c = coarse_[level][1];
        Real* const v = coarse_[level][2];
        Real* const d = coarse_[level][3];
        precondition(level, r, c);
        if (is_last(level) && engine_.has_bottom) return;
        PerFunction<W> const along_r = dot<W>(c, r, rows.n);
        PerFunction<W> const along = multiply<W>(rows, c, v);
        PerFunction<W> step, minus_step;
        for (Index k = 0; k < W; ++k) {
            step[k] = per_energy(along_r[k], along[k]);
            minus_step[k] = -step[k];
        }
        add_multiple<W>(minus_step, v, r, rows.n);

        precondition(level, r, d);
        PerFunction<W> const across = dot<W>(d, v, rows.n);
        PerFunction<W> const second_r = dot<W>(d, r, rows.n);
        PerFunction<W> const second = energy<W>(rows, d);
        count_products(level, 2);
        PerFunction<W> second_step;
        for (Index k = 0; k < W; ++k) {
            Real const projection = per_energy(across[k], along[k]);
            second_step[k] = per_energy(second_r[k], second[k] - projection * across[k]);
            step[k] -= projection * second_step[k];
        }
        combine<W>(step, c, second_step, d, rows.n);
    }

    void solve_bottom(Real* x) const noexcept {
        Index const n = a_.level[a_.count - 1].n;
        Real column[Agglomeration::coarsest];
        for (Index k = 0; k < W; ++k) {
            for (Index i = 0; i < n; ++i) column[i] = x[Offset{i} * W + k];
            engine_.bottom.solve({column, static_cast<Size>(n)});
            for (Index i = 0; i < n; ++i) x[Offset{i} * W + k] = column[i];
        }
    }

    Multigrid const& engine_;
    Agglomeration const& a_;
    Real work_ = 0;
    Real* coarse_[Agglomeration::max_levels][Multigrid::coarse_vectors];
};

// Flexible conjugate gradients for functions first .. first + W - 1 of `values`; functions behind
// the last one are 0.
template <Index W>
class ConjugateGradients {
public:
    ConjugateGradients(Multigrid const& engine, Real* vectors, Rows const& values,
                       Index first) noexcept
        : engine_(engine),
          rows_(engine.levels.level[0]),
          cycle_(engine, vectors),
          values_(values),
          first_(first),
          width_(min(W, values.width - first)) {}

    // Calls after(iteration, largest relative residual of all functions); if it fails, the
    // iteration ends.
    template <class After>
    Status run(IterationReport& report, After const& after) noexcept {
        Index& iterations = report.iterations;
        for (Index i = 0; i < rows_.n; ++i) {
            Real* const row = r() + Offset{i} * W;
            const Real* const given = values_[i] + first_;
            for (Index k = 0; k < W; ++k) row[k] = k < width_ ? given[k] : 0;
        }
        clear<W>(x(), rows_.n);
        squares_ = first_squares_ = dot<W>(r(), r(), rows_.n);
        errors_ = {};
        HARMORPH_TRY(after(0, largest_residual()));
        // The recursively updated residual drifts from the true one, so a function has converged
        // only if the true residual agrees.
        for (Index descents = 0; descents < 3 && iterations < engine_.iteration.max_iterations;
             ++descents) {
            HARMORPH_TRY(descend(iterations, after));
            take_true_residual();
            for (Index k = 0; k < W; ++k) is_confirmed_[k] = is_done(k);
            if (converged()) break;
        }
        for (Index k = 0; k < W; ++k)
            report.settled = report.settled && (is_confirmed_[k] || is_settled(k));
        report.work = cycle_.work();
        for (Index i = 0; i < rows_.n; ++i) {
            Real* const to = values_[i] + first_;
            for (Index k = 0; k < width_; ++k) to[k] = x()[Offset{i} * W + k];
        }
        return Status::ok;
    }

private:
    Real* x() const noexcept { return cycle_.finest[0]; }
    Real* r() const noexcept { return cycle_.finest[1]; }
    Real* z() const noexcept { return cycle_.finest[2]; }
    Real* p() const noexcept { return cycle_.finest[3]; }
    Real* q() const noexcept { return cycle_.finest[4]; }

    // Thin cells have by far the largest entries, so elsewhere a small norm of the residual, or a
    // small energy, may hide a large error. B r approximates the error; the maximum of B r must be
    // small relative to the largest value.
    bool is_settled(Index k) const noexcept {
        return errors_[k] <= engine_.iteration.tolerance * sizes_[k];
    }
    bool is_small(Index k) const noexcept {
        return sqrt(squares_[k]) <= engine_.iteration.tolerance * sqrt(first_squares_[k]);
    }
    bool is_done(Index k) const noexcept {
        return is_confirmed_[k] || (is_small(k) && is_settled(k));
    }
    bool converged() const noexcept {
        for (Index k = 0; k < W; ++k) {
            if (!is_done(k)) return false;
        }
        return true;
    }
    Real largest_residual() const noexcept {
        Real largest = 0;
        for (Index k = 0; k < width_; ++k) {
            Real const ratio = first_squares_[k] > 0 ? squares_[k] / first_squares_[k] : 0;
            if (exceeds(ratio, largest)) largest = ratio;
        }
        return sqrt(largest);
    }

    template <class After>
    Status descend(Index& iterations, After const& after) noexcept {
        Index const n = rows_.n;
        PerFunction<W> one;
        for (Index k = 0; k < W; ++k) one[k] = 1;
        cycle_.precondition(r(), z());
        estimate_errors();
        copy<W>(z(), p(), n);
        while (iterations < engine_.iteration.max_iterations && !converged()) {
            PerFunction<W> const along = multiply<W>(rows_, p(), q());
            cycle_.count_products(0, 1);
            // The step leads to the minimum of the energy along p, so the energy of the error never
            // grows for any p.
            PerFunction<W> step = dot<W>(p(), r(), n), minus_step;
            // Converged functions keep their values.
            for (Index k = 0; k < W; ++k) {
                step[k] = is_done(k) ? 0 : per_energy(step[k], along[k]);
                minus_step[k] = -step[k];
            }
            add_multiple<W>(step, p(), x(), n);
            squares_ = add_multiple<W>(minus_step, q(), r(), n);
            ++iterations;
            HARMORPH_TRY(after(iterations, largest_residual()));
            cycle_.precondition(r(), z());
            estimate_errors();
            PerFunction<W> beta = dot<W>(z(), q(), n);
            for (Index k = 0; k < W; ++k) beta[k] = per_energy(-beta[k], along[k]);
            combine<W>(beta, p(), one, z(), n);
        }
        return Status::ok;
    }

    void estimate_errors() noexcept {
        errors_ = largest<W>(z(), rows_.n);
        sizes_ = largest<W>(x(), rows_.n);
    }

    void take_true_residual() noexcept {
        multiply<W>(rows_, x(), q());
        cycle_.count_products(0, 1);
        squares_ = {};
        for (Index i = 0; i < rows_.n; ++i) {
            const Real* const given = values_[i] + first_;
            for (Index k = 0; k < W; ++k) {
                Offset const at = Offset{i} * W + k;
                r()[at] = (k < width_ ? given[k] : 0) - q()[at];
                squares_[k] += r()[at] * r()[at];
            }
        }
    }

    Multigrid const& engine_;
    SymmetricRows const& rows_;
    Cycle<W> cycle_;
    Rows const& values_;
    Index first_, width_;
    // The squared norms of the residuals, of the current ones and of those at the beginning.
    PerFunction<W> squares_, first_squares_;
    PerFunction<W> errors_, sizes_;  // The maxima of |B r| and |x|.
    // The function has converged by the true residual and is not changed any more.
    bool is_confirmed_[W] = {};
};

}  // namespace harmorph::block
