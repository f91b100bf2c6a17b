// The cycle through the levels for a block of functions. tests/multigrid/test_multigrid.cpp covers
// this file.
#pragma once

#include "multigrid/multigrid.hpp"

namespace harmorph {

// The cycle for blocks of `width` functions, in the precision of Number. B is the approximation of
// the inverse of A that a cycle applies; B is symmetric and positive definite, and the eigenvalues
// of B A are at most 1. On the finest levels the cycle is a V-cycle. Coarser levels are solved by
// two cycles (W-cycle), the second one for the residual of the first one: 2 B - B A B. W-cycles
// take little work, and without the second cycle the iterations grow with the number of levels.
template <class Number>
class Cycle {
public:
    // vectors [CoarsePoints::coarse_points() x width]: one vector for each coarse level, and a
    // second one for each level that is solved by two cycles, as far as the memory suffices.
    Cycle(Multigrid const& engine, Index width, Number* vectors) noexcept
        : engine_(engine), kernels_(cycle_kernels<Number>(engine.kernel)), width_(width) {
        Index const count = engine.levels.count;
        Offset left = CoarsePoints::coarse_points(engine.levels.finest.n);
        auto const take = [&](Index level) {
            Number* const vector = vectors;
            vectors += Offset{level_[level].n} * width;
            left -= level_[level].n;
            return vector;
        };
        for (Index l = 0; l < count; ++l) level_[l] = engine.cycle_level<Number>(l);
        for (Index l = 1; l < count; ++l) coarse_[l] = take(l);
        // A second cycle gains nothing on the last level, which is solved exactly or has no coarser
        // one.
        for (Index l = count - 2; l >= first_of_two_cycles && level_[l].n <= left; --l)
            residual_[l] = take(l);
    }

    // The first half of a cycle on the finest level is descend(), or is included in update(). The
    // rest, ascend(), replaces z by B r and adds z.q to `product`.
    void update(FunctionBlock const& block, Number* z,
                typename CycleKernels<Number>::Update& task) noexcept {
        if (task.descends) count_products(0, 1);
        kernels_.update(level_[0], block, z, coarse(0), task);
    }
    void descend(Number* z) noexcept { descend(0, z); }
    void ascend(Number* z, const Number* q, Real* product) noexcept {
        if (engine_.levels.count > 1) precondition(1, coarse_[1]);
        ascend(0, z, q, product);
    }
    void multiply(Index planes, typename CycleKernels<Number>::Product& task) noexcept {
        count_products(0, 1);
        kernels_.multiply(level_[0], width_, planes, task);
    }
    void find_residual(FunctionBlock const& block,
                       typename CycleKernels<Number>::Residual& task) noexcept {
        kernels_.find_residual(block, task);
    }
    void count_products(Index level, Index n) noexcept { work_ += n * engine_.product_work[level]; }
    // Returns the work of all calls so far, see IterationReport::work.
    Real work() const noexcept { return work_; }

private:
    Number* coarse(Index level) const noexcept {
        return level + 1 < engine_.levels.count ? coarse_[level + 1] : nullptr;
    }
    // Both halves of a cycle take two passes through one triangle of the matrix.
    void descend(Index level, Number* x) noexcept {
        count_products(level, 1);
        kernels_.descend(level_[level], width_, x, coarse(level));
    }
    void ascend(Index level, Number* x, const Number* q, Real* product) noexcept {
        count_products(level, 1);
        kernels_.ascend(level_[level], width_, coarse(level), x, q, product);
    }
    void precondition(Index level, Number* x) noexcept {
        bool const is_last = level + 1 == engine_.levels.count;
        if (is_last && engine_.has_bottom) return solve_bottom(x);
        Number* const residual = residual_[level];
        Offset const numbers = Offset{level_[level].n} * width_;
        if (residual != nullptr)
            std::memcpy(residual, x, static_cast<Size>(numbers) * sizeof(Number));
        cycle(level, x, is_last);
        if (residual == nullptr) return;
        subtract_product(level, x, residual);
        cycle(level, residual, is_last);
        for (Offset k = 0; k < numbers; ++k) x[k] += residual[k];
    }
    void cycle(Index level, Number* x, bool is_last) noexcept {
        descend(level, x);
        if (!is_last) precondition(level + 1, coarse_[level + 1]);
        ascend(level, x, nullptr, nullptr);
    }
    // Computes residual -= A x.
    void subtract_product(Index level, const Number* x, Number* residual) noexcept {
        count_products(level, 1);
        CycleLevel<Number> const& rows = level_[level];
        for (Index i = 0; i < rows.n; ++i) {
            const Number* const own = x + Offset{i} * width_;
            Number* const to = residual + Offset{i} * width_;
            for (Index k = 0; k < width_; ++k) to[k] -= rows.diagonal[i] * own[k];
            for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
                Number const entry = rows.value[e];
                Offset const column = Offset{rows.column[e]} * width_;
                for (Index k = 0; k < width_; ++k) {
                    to[k] -= entry * x[column + k];
                    residual[column + k] -= entry * own[k];
                }
            }
        }
    }
    void solve_bottom(Number* x) const noexcept {
        Index const n = level_[engine_.levels.count - 1].n;
        Real column[CoarsePoints::coarsest];
        for (Index k = 0; k < width_; ++k) {
            for (Index i = 0; i < n; ++i) column[i] = x[Offset{i} * width_ + k];
            engine_.bottom.solve({column, static_cast<Size>(n)});
            for (Index i = 0; i < n; ++i)
                x[Offset{i} * width_ + k] = static_cast<Number>(column[i]);
        }
    }

    static constexpr Index first_of_two_cycles = 3;

    Multigrid const& engine_;
    CycleKernels<Number> const& kernels_;
    Index width_;
    Real work_ = 0;
    CycleLevel<Number> level_[CoarsePoints::max_levels];
    Number* coarse_[CoarsePoints::max_levels];
    Number* residual_[CoarsePoints::max_levels] = {};
};

}  // namespace harmorph
