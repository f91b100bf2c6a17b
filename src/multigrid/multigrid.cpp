#include "multigrid/multigrid.hpp"

#include "base/flush_denormals.hpp"
#include "multigrid/iteration.hpp"
#include "multigrid/multigrid_cycle.hpp"

namespace harmorph {
namespace {

// Flexible conjugate gradients in the precision of the cycle for a block of functions, with
// residuals that are replaced by those in double precision. Source: G. L. G. Sleijpen, H. A. van
// der Vorst, Computing 56 (1996) 141 (reliable updates of the residual).

// Solves for functions first .. first + width - 1 of the values. The solution x is in double
// precision, and is stored where the values are; the right-hand sides follow from the values on the
// wall. The vectors r, p, q = A p and z are in the precision of Number; those of a function are
// multiplied by a power of two, `scale`, that keeps them within the range of Number. Nothing that
// happens to a function depends on the other functions of the block.
template <class Number>
class ConjugateGradients {
    static constexpr Index max_width = FunctionBlock::max_width;
    // In single precision, rounding errors of the updated residual add up; after so many iterations
    // the residual is replaced, if it has become smaller by the factor `much`.
    static constexpr Index replacing_iterations = 6;
    static constexpr Real much = 1e-2;
    static constexpr bool replaces = sizeof(Number) < sizeof(Real);

public:
    ConjugateGradients(Multigrid const& engine, Index width, Number* vectors, Matrix const& matrix,
                       DofValues const& dofs, Index first) noexcept
        : engine_(engine),
          matrix_(matrix),
          dofs_(dofs),
          n_(engine.levels.finest.n),
          r_(vectors),
          p_(r_ + Offset{n_} * width),
          q_(p_ + Offset{n_} * width),
          z_(q_ + Offset{n_} * width),
          cycle_(engine, width, z_ + Offset{n_} * width) {
        block_.width = width;
        block_.planes = engine.is_complex() ? 2 : 1;
        block_.values = dofs.rows(matrix);
        block_.first = first;
        block_.functions = min(block_.plane_width(), block_.values.width - first);
        for (Index k = block_.functions; k < columns(); ++k) is_confirmed_[k] = true;
    }

    // Calls after(iteration, largest relative residual of all functions); if it fails, the
    // iteration ends.
    template <class After>
    Status run(IterationReport& report, After const& after) noexcept {
        Flush<Number> const flush;
        static_cast<void>(flush);
        begin();
        HARMORPH_TRY(after(0, largest_residual()));
        // The updated residual drifts from the true one, so a function has converged only if the
        // true residual agrees.
        Index& iterations = report.iterations;
        for (Index descents = 0; descents < 3 && iterations < engine_.iteration.max_iterations;
             ++descents) {
            HARMORPH_TRY(iterate(iterations, after));
            find_residual(Choice::every());
            for (Index k = 0; k < columns(); ++k) is_confirmed_[k] = is_done(k);
            if (converged()) break;
            for (Index k = 0; k < columns(); ++k)
                if (!is_confirmed_[k]) errors_[k] = infinity;
        }
        for (Index k = 0; k < columns(); ++k)
            report.settled = report.settled && (is_confirmed_[k] || is_settled(k));
        report.work = cycle_.work();
        return Status::ok;
    }

private:
    using Choice = FunctionBlock::Choice;
    // Functions are counted by the columns of their real parts.
    Index columns() const noexcept { return block_.plane_width(); }
    // Copies numbers of functions to those of their imaginary parts.
    template <class Of>
    void repeat(Of (&numbers)[max_width]) const noexcept {
        for (Index k = columns(); k < block_.width; ++k) numbers[k] = numbers[k - columns()];
    }
    // Adds sums of imaginary parts to those of the functions.
    void join(Real (&sums)[max_width]) const noexcept {
        for (Index k = columns(); k < block_.width; ++k) sums[k - columns()] += sums[k];
    }

    void begin() noexcept {
        for (Index k = 0; k < max_width; ++k) {
            squares_[k] = 0;
            errors_[k] = infinity;
            scale_[k] = 1;
        }
        clear(r_);  // Parts without functions are not written below.
        for_parts([&](Index from, Index n) {
            block_.take_right_hand_sides(matrix_, dofs_, from, n, wide());
            const Real* rest = wide();
            for (Index i = 0; i < n_; ++i) {
                for (Index plane = 0; plane < block_.planes; ++plane) {
                    for (Index k = from; k < from + n; ++k, ++rest) squares_[k] += *rest * *rest;
                }
            }
            if (dofs_.is_start) return;
            for (Index k = from; k < from + n; ++k) scale_[k] = factor_for(squares_[k]);
            rest = wide();
            for (Index i = 0; i < n_; ++i) {
                for (Index plane = 0; plane < block_.planes; ++plane) {
                    Number* const to = r_ + Offset{i} * block_.width + plane * columns();
                    for (Index k = from; k < from + n; ++k, ++rest)
                        to[k] = static_cast<Number>(scale_[k] * *rest);
                }
            }
        });
        for (Index k = 0; k < columns(); ++k)
            first_squares_[k] = replaced_squares_[k] = squares_[k];
        if (!dofs_.is_start) return block_.clear(n_, Choice::every());
        find_residual(Choice::every());
        // A function starts from its value if the energy of the error, x.A x - 2 b.x but for a
        // constant, is less than that of the start 0. A value that is no number is no such start.
        Choice is_worse;
        bool any = false;
        for (Index k = 0; k < columns(); ++k) {
            is_worse.column[k] = !(2 * product_[k] + energy_[k] > 0);
            any = any || is_worse.column[k];
        }
        if (!any) return;
        block_.clear(n_, is_worse);
        for (Index k = 0; k < columns(); ++k)
            if (is_worse.column[k]) squares_[k] = first_squares_[k];
        find_residual(is_worse);
    }

    // The array z is working space for residuals in double precision, with as many columns as fit.
    // Calls body(first column, number of columns).
    Real* wide() const noexcept { return reinterpret_cast<Real*>(z_); }
    template <class Body>
    void for_parts(Body const& body) const noexcept {
        constexpr Index numbers = sizeof(Real) / sizeof(Number);
        Index const n = columns() / numbers;
        for (Index from = 0; from < columns() && from < block_.functions; from += n) body(from, n);
    }
    // Returns a power of two that makes a vector with this squared norm about 1 long.
    static Real factor_for(Real squares) noexcept {
        constexpr Real smallest = 1e-290;
        Real const norm = sqrt(squares);
        return norm > smallest ? 1 / power_of_two_at(norm) : 1;
    }
    // Replaces the residuals of the chosen functions by the true ones.
    void find_residual(Choice const& chosen) noexcept {
        typename CycleKernels<Number>::Residual task{};
        task.rows = &engine_.levels.finest;
        task.imaginary = engine_.imaginary;
        task.rest = wide();
        task.r = r_;
        for (Index k = 0; k < columns(); ++k) {
            task.scale[k] = factor_for(squares_[k]);
            task.takes[k] = chosen.column[k];
        }
        for_parts([&](Index from, Index n) {
            bool any = false;
            for (Index k = from; k < from + n; ++k) any = any || chosen.column[k];
            if (!any) return;
            block_.take_right_hand_sides(matrix_, dofs_, from, n, wide());
            task.begin = from;
            task.columns = n;
            cycle_.find_residual(block_, task);
        });
        cycle_.count_products(0, 1);
        for (Index k = 0; k < columns(); ++k) {
            if (!chosen.column[k]) continue;
            scale_[k] = task.scale[k];
            squares_[k] = replaced_squares_[k] = task.squares[k];
            energy_[k] = task.energy[k];
            product_[k] = task.product[k];
        }
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
        for (Index k = 0; k < columns(); ++k) {
            if (!is_done(k)) return false;
        }
        return true;
    }
    Real largest_residual() const noexcept {
        Real largest = 0;
        for (Index k = 0; k < columns(); ++k) {
            Real const ratio = first_squares_[k] > 0 ? squares_[k] / first_squares_[k] : 0;
            if (exceeds(ratio, largest)) largest = ratio;
        }
        return sqrt(largest);
    }

    template <class After>
    Status iterate(Index& iterations, After const& after) noexcept {
        clear(p_);
        clear(q_);
        for (Index k = 0; k < max_width; ++k) along_[k] = 0;
        descend();
        ascend();
        typename CycleKernels<Number>::Update update;
        update.p = p_;
        update.q = q_;
        update.r = r_;
        while (iterations < engine_.iteration.max_iterations && !converged()) {
            find_steps(update);
            ++iterations;
            bool const may_replace = replaces && iterations % replacing_iterations == 0;
            update.descends = !may_replace;
            for (Real& sum : update.squares) sum = 0;
            cycle_.update(block_, z_, update);
            join(update.squares);
            for (Index k = 0; k < columns(); ++k)
                squares_[k] = update.squares[k] / (scale_[k] * scale_[k]);
            HARMORPH_TRY(after(iterations, largest_residual()));
            if (may_replace) {
                replace();
                descend();
            }
            ascend();
        }
        return Status::ok;
    }

    // Computes the next directions p and the lengths of the steps along them.
    void find_steps(typename CycleKernels<Number>::Update& update) noexcept {
        typename CycleKernels<Number>::Product product{};
        product.row_sum = engine_.levels.finest.row_sum.data();
        product.imaginary = engine_.imaginary;
        product.r = r_;
        product.p = p_;
        product.q = q_;
        product.z = z_;
        // Functions that are done keep their values, and would go on in the direction of B r.
        for (Index k = 0; k < columns(); ++k)
            product.beta[k] = static_cast<Number>(is_done(k) ? 0 : beta_[k]);
        repeat(product.beta);
        cycle_.multiply(block_.planes, product);
        for (Index k = 0; k < columns(); ++k) {
            // The step leads to the minimum of the energy along p, so the energy of the error never
            // grows for any p.
            along_[k] = product.energy[k];
            Real const step = is_done(k) ? 0 : per_energy(product.along[k], product.energy[k]);
            update.step[k] = static_cast<Number>(step);
            update.factor[k] = static_cast<Real>(update.step[k]) / scale_[k];
        }
        repeat(update.step);
        repeat(update.factor);
    }

    Size vector_bytes() const noexcept {
        return sizeof(Number) * static_cast<Size>(Offset{n_} * block_.width);
    }
    void clear(Number* vector) const noexcept { std::memset(vector, 0, vector_bytes()); }
    void replace() noexcept {
        Choice chosen{};
        bool any = false;
        for (Index k = 0; k < columns(); ++k) {
            chosen.column[k] = !is_done(k) && squares_[k] <= much * much * replaced_squares_[k];
            any = any || chosen.column[k];
        }
        if (any) find_residual(chosen);
    }
    void descend() noexcept {
        std::memcpy(z_, r_, vector_bytes());
        cycle_.descend(z_);
    }
    // Completes z = B r. If the residual of a function is small, the largest values of B r and of x
    // are computed, too.
    void ascend() noexcept {
        Real products[max_width] = {};
        cycle_.ascend(z_, q_, products);
        join(products);
        bool any_small = false;
        for (Index k = 0; k < columns(); ++k) {
            beta_[k] = per_energy(-products[k], along_[k]);
            any_small = any_small || (is_small(k) && !is_confirmed_[k] && !is_settled(k));
        }
        if (any_small) find_largest();
    }
    void find_largest() noexcept {
        block_.find_largest(n_, z_, errors_, sizes_);
        for (Index k = 0; k < columns(); ++k) errors_[k] /= scale_[k];
    }

    // Returns the step along a direction, or 0 if the direction has no energy, or so little that
    // the quotient would overflow.
    static Real per_energy(Real product, Real energy) noexcept {
        constexpr Real smallest = 1e-30;
        return energy > 0 && smallest * abs(product) <= energy ? product / energy : 0;
    }

    Multigrid const& engine_;
    Matrix const& matrix_;
    DofValues const& dofs_;
    Index n_;
    Number *r_, *p_, *q_, *z_;
    Cycle<Number> cycle_;
    FunctionBlock block_;
    Real scale_[max_width];
    // The squared norms of the residuals: of the current ones, of those at the last replacement,
    // and of the right-hand sides.
    Real squares_[max_width], replaced_squares_[max_width] = {}, first_squares_[max_width];
    Real energy_[max_width] = {}, product_[max_width] = {};  // These are x.A x and x.r.
    Real along_[max_width], beta_[max_width];         // p.A p; the next direction is B r + beta p.
    Real errors_[max_width], sizes_[max_width] = {};  // These are the maxima of |B r| and |x|.
    // The function has converged by the true residual and is not changed any more.
    bool is_confirmed_[max_width] = {};
};

}  // namespace

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
