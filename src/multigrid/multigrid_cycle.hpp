// The V-cycle for a block of functions. tests/multigrid/test_multigrid.cpp covers this file.
#pragma once

#include "multigrid/multigrid.hpp"

namespace harmorph {

// The V-cycle for blocks of `width` functions, in the precision of Number. B is the approximation
// of the inverse of A that a cycle applies; B is symmetric and positive definite.
template <class Number>
class Cycle {
public:
    // vectors [coarse points x width]: one vector for each coarse level.
    Cycle(Multigrid const& engine, Index width, Number* vectors) noexcept
        : engine_(engine), kernels_(cycle_kernels<Number>(engine.kernel)), width_(width) {
        for (Index l = 0; l < engine.levels.count; ++l) level_[l] = engine.cycle_level<Number>(l);
        for (Index l = 1; l < engine.levels.count; ++l) {
            coarse_[l] = vectors;
            vectors += Offset{level_[l].n} * width;
        }
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
        descend(level, x);
        if (!is_last) precondition(level + 1, coarse_[level + 1]);
        ascend(level, x, nullptr, nullptr);
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

    Multigrid const& engine_;
    CycleKernels<Number> const& kernels_;
    Index width_;
    Real work_ = 0;
    CycleLevel<Number> level_[CoarsePoints::max_levels];
    Number* coarse_[CoarsePoints::max_levels];
};

}  // namespace harmorph
