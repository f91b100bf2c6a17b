// The V-cycle for a block of W functions, and the conjugate gradients that it preconditions.
// tests/multigrid/test_multigrid.cpp covers this file.
#pragma once

#include "base/scalar.hpp"
#include "multigrid/block_rows.hpp"
#include "multigrid/multigrid.hpp"

namespace harmorph::block {

// Returns the step along a direction, or 0 if the direction has no energy, or so little that the
// quotient would overflow.
inline Real per_energy(Real product, Real energy) noexcept {
    constexpr Real smallest = 1e-150;
    return energy > 0 && smallest * abs(product) <= energy ? product / energy : 0;
}

// The V-cycle for a block of W functions, in the precision of Number.
template <Index W, class Number>
class Cycle {
public:
    // vectors: one for each coarse level.
    Cycle(Multigrid const& engine, Number* vectors) noexcept
        : engine_(engine), levels_(engine.levels) {
        for (Index l = 1; l < levels_.count; ++l) {
            coarse_[l] = vectors;
            vectors += Offset{levels_.n(l)} * W;
        }
    }

    // Replaces r by B r, where B approximates the inverse; B is symmetric and positive definite.
    void precondition(Number* r) noexcept { precondition(0, r); }

    // Returns the work of all calls so far, see IterationReport::work.
    Real work() const noexcept { return work_; }
    void count_products(Index level, Index n) noexcept { work_ += n * engine_.product_work[level]; }

private:
    void precondition(Index level, Number* x) noexcept {
        bool const is_last = level + 1 == levels_.count;
        if (is_last && engine_.has_bottom) return solve_bottom(x);
        // Each of the four passes goes through one triangle of the matrix.
        count_products(level, is_last ? 1 : 2);
        levels_.visit(level, [&](auto const& rows) {
            forward<W>(rows, x);
            if (is_last) {
                scale_by_diagonal<W>(rows, x);
            } else {
                Number* const coarse = coarse_[level + 1];
                Prolongation const& by = levels_.finer[level];
                to_defect<W>(rows, by, levels_.n(level + 1), x, coarse);
                precondition(level + 1, coarse);
                correct<W>(rows, by, coarse, x);
            }
            backward<W>(rows, x);
        });
    }

    void solve_bottom(Number* x) const noexcept {
        Index const n = levels_.n(levels_.count - 1);
        Real column[CoarsePoints::coarsest];
        for (Index k = 0; k < W; ++k) {
            for (Index i = 0; i < n; ++i) column[i] = x[Offset{i} * W + k];
            engine_.bottom.solve({column, static_cast<Size>(n)});
            for (Index i = 0; i < n; ++i) x[Offset{i} * W + k] = static_cast<Number>(column[i]);
        }
    }

    Multigrid const& engine_;
    CoarsePoints const& levels_;
    Real work_ = 0;
    Number* coarse_[CoarsePoints::max_levels];
};

// Flexible conjugate gradients for functions first .. first + W - 1 of `values`; functions behind
// the last one are 0. If they are complex, the block has the real parts and then the imaginary
// parts of half as many; sums of both belong to the function.
template <Index W, class Number>
class ConjugateGradients {
public:
    ConjugateGradients(Multigrid const& engine, Real* vectors, Matrix const& matrix,
                       DofValues const& dofs, Index first) noexcept
        : engine_(engine),
          rows_(engine.levels.finest),
          x_(vectors),
          r_(x_ + Offset{rows_.n} * W),
          q_(r_ + Offset{rows_.n} * W),
          z_(reinterpret_cast<Number*>(q_ + Offset{rows_.n} * W)),
          p_(z_ + Offset{rows_.n} * W),
          cycle_(engine, p_ + Offset{rows_.n} * W),
          matrix_(matrix),
          dofs_(dofs),
          values_(dofs.rows(matrix)) {
        Index const functions = engine.is_complex() ? W / 2 : W;
        for (Index k = 0; k < W; ++k) {
            Index const function = first + k % functions;
            Offset const place = k < functions ? function : values_.plane + function;
            place_[k] = function < values_.width ? place : -1;
        }
    }

    // Calls after(iteration, largest relative residual of all functions); if it fails, the
    // iteration ends.
    template <class After>
    Status run(IterationReport& report, After const& after) noexcept {
        Index& iterations = report.iterations;
        take_right_hand_sides();
        squares_ = first_squares_ = joined(dot<W>(r_, r_, rows_.n));
        if (dofs_.is_start) {
            take_start();
        } else {
            clear<W>(x_, rows_.n);
        }
        for (Index k = 0; k < W; ++k) errors_[k] = infinity;
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
            for (Index k = 0; k < W; ++k) {
                if (place_[k] >= 0) values_[i][place_[k]] = x_[Offset{i} * W + k];
            }
        }
        return Status::ok;
    }

private:
    // Copies the columns of the block from the values of the unknowns.
    void copy_values(Real* to) const noexcept {
        for (Index i = 0; i < rows_.n; ++i) {
            for (Index k = 0; k < W; ++k)
                to[Offset{i} * W + k] = place_[k] >= 0 ? values_[i][place_[k]] : 0;
        }
    }
    void take_right_hand_sides() const noexcept {
        if (!dofs_.is_start) return copy_values(r_);
        clear<W>(r_, rows_.n);
        for (Index wall = 0; wall + 1 < matrix_.coupling_start.count(); ++wall) {
            const Real* const known = dofs_.wall(wall);
            PerFunction<W> value, turned;  // The known value, and i times this value.
            for (Index k = 0; k < W; ++k) value[k] = place_[k] >= 0 ? known[place_[k]] : 0;
            for (Index k = 0; k < W / 2; ++k)
                turned[k] = -value[k + W / 2], turned[k + W / 2] = value[k];
            for (Index c = matrix_.coupling_start[wall]; c < matrix_.coupling_start[wall + 1];
                 ++c) {
                Real* const row = r_ + Offset{matrix_.coupling_row[c]} * W;
                add<W>(-matrix_.coupling_value[c], value.at, row);
                if (engine_.is_complex()) add<W>(-matrix_.coupling_imaginary[c], turned.at, row);
            }
        }
    }
    // Starts each function from its value if the energy of the error, x.A x - 2 b.x but for a
    // constant, is less than that of the start 0. A value that is no number is no such start.
    void take_start() noexcept {
        copy_values(x_);
        PerFunction<W> const energy = multiply(x_, q_), product = joined(dot<W>(x_, r_, rows_.n));
        for (Offset at = 0; at < Offset{rows_.n} * W; at += W) {
            for (Index k = 0; k < W; ++k) {
                bool const is_better = energy[k] < 2 * product[k];
                x_[at + k] = is_better ? x_[at + k] : 0;
                r_[at + k] -= is_better ? q_[at + k] : 0;
            }
        }
        squares_ = joined(dot<W>(r_, r_, rows_.n));
    }
    // The sums or the largest values of real and imaginary parts.
    PerFunction<W> joined(PerFunction<W> const& parts) const noexcept {
        return join(parts, [](Real a, Real b) { return a + b; });
    }
    PerFunction<W> largest_joined(PerFunction<W> const& parts) const noexcept {
        return join(parts, [](Real a, Real b) { return exceeds(b, a) ? b : a; });
    }
    template <class Join>
    PerFunction<W> join(PerFunction<W> parts, Join const& both) const noexcept {
        if (!engine_.is_complex()) return parts;
        for (Index k = 0; k < W / 2; ++k)
            parts[k] = parts[k + W / 2] = both(parts[k], parts[k + W / 2]);
        return parts;
    }
    template <class Vector>
    PerFunction<W> multiply(const Vector* x, Real* y) noexcept {
        cycle_.count_products(0, 1);
        return engine_.is_complex() ? block::multiply<W>(rows_, engine_.imaginary, x, y)
                                    : block::multiply<W>(rows_, x, y);
    }

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
        for (Index k = 0; k < W; ++k) {
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
        precondition();
        copy<W>(z_, p_, n);
        while (iterations < engine_.iteration.max_iterations && !converged()) {
            PerFunction<W> const along = multiply(p_, q_);
            // The step leads to the minimum of the energy along p, so the energy of the error never
            // grows for any p.
            PerFunction<W> step = joined(dot<W>(p_, r_, n)), minus_step;
            // Converged functions keep their values.
            for (Index k = 0; k < W; ++k) {
                step[k] = is_done(k) ? 0 : per_energy(step[k], along[k]);
                minus_step[k] = -step[k];
            }
            add_multiple<W>(step, p_, x_, n);
            squares_ = joined(add_multiple<W>(minus_step, q_, r_, n));
            ++iterations;
            HARMORPH_TRY(after(iterations, largest_residual()));
            precondition();
            PerFunction<W> beta = joined(dot<W>(z_, q_, n));
            for (Index k = 0; k < W; ++k) beta[k] = per_energy(-beta[k], along[k]);
            combine<W>(beta, p_, one, z_, n);
        }
        return Status::ok;
    }

    // Computes z = a B r. The factor a is a power of two that keeps z within the range of Number;
    // conjugate gradients do not depend on the length of z. If the residual of a function is small,
    // the largest values of B r and of x are computed, too.
    void precondition() noexcept {
        constexpr Real smallest = 1e-290;
        PerFunction<W> factor;
        bool any_small = false;
        for (Index k = 0; k < W; ++k) {
            Real const norm = sqrt(squares_[k]);
            factor[k] = norm > smallest ? 1 / power_of_two_at(norm) : 1;
            any_small = any_small || is_small(k);
        }
        convert<W>(factor, r_, z_, rows_.n);
        cycle_.precondition(z_);
        if (!any_small) return;
        errors_ = largest_joined(largest<W>(z_, rows_.n));
        for (Index k = 0; k < W; ++k) errors_[k] /= factor[k];
        sizes_ = largest_joined(largest<W>(x_, rows_.n));
    }

    void take_true_residual() noexcept {
        multiply(x_, q_);
        take_right_hand_sides();
        PerFunction<W> minus_one;
        for (Index k = 0; k < W; ++k) minus_one[k] = -1;
        squares_ = joined(add_multiple<W>(minus_one, q_, r_, rows_.n));
    }

    Multigrid const& engine_;
    SymmetricRows const& rows_;
    Real *x_, *r_, *q_;
    Number *z_, *p_;
    Cycle<W, Number> cycle_;
    Matrix const& matrix_;
    DofValues const& dofs_;
    Rows values_;
    Offset place_[W];  // of each column of the block in a row of `values`; -1 behind the last one.
    // The squared norms of the residuals, of the current ones and of those at the beginning.
    PerFunction<W> squares_, first_squares_;
    PerFunction<W> errors_, sizes_;  // The maxima of |B r| and |x|.
    // The function has converged by the true residual and is not changed any more.
    bool is_confirmed_[W] = {};
};

}  // namespace harmorph::block
