// The convergence of an iteration for a block of W functions. Each function ends when it has
// converged, when it diverges or at the last cycle, independently of the others. Its values are
// stored at that cycle, so that their bits do not depend on the other functions of the block.
// tests/multigrid/test_full_approximation.cpp covers this file.
#pragma once

#include "multigrid/block_rows.hpp"
#include "multigrid/iteration.hpp"

namespace harmorph::block {

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

}  // namespace harmorph::block
