// What the iterative engines have in common: what they are asked for, their levels, and blocks of functions.
#pragma once

#include <type_traits>

#include "harmorph/multigrid/agglomeration.hpp"
#include "harmorph/base/executor.hpp"
#include "harmorph/base/progress.hpp"
#include "harmorph/base/row_view.hpp"

namespace harmorph {

struct Iteration {
    MergingRules merging;
    Index block_width = 8;       // functions that are solved at a time: 4, 8 or 16
    Index max_iterations = 0;
    bool starts_from_zero = false;  // full approximation scheme: not with the coarsest level's solution
    // Of each function: relative residual, in 2-norms, and about what values are off beside the largest one.
    Real tolerance = 1e-10;
    Span<Real> history;          // the caller's, or empty: largest relative residual before the first iteration and after each

    // run(the block's width as a constant type)
    template <class Run>
    Status with_width(Run const& run) const noexcept {
        switch (block_width) {
            case 4: return run(std::integral_constant<Index, 4>{});
            case 8: return run(std::integral_constant<Index, 8>{});
            default: return run(std::integral_constant<Index, 16>{});
        }
    }
    static constexpr bool has_width(Index width) noexcept { return width == 4 || width == 8 || width == 16; }
};

struct IterationReport {
    Index iterations = 0;   // largest over the functions
    Index fine_sweeps = 0;  // of the smoother over the finest level, largest over the functions
    Index levels = 0;
    bool settled = true;    // what values are still off is within the tolerance, as far as it can be told
};

// Functions are solved in blocks; a lane is one thread's sequence of blocks, with vectors and a history of its own.
struct BlockIteration {
    Iteration iteration;
    Executor executor;
    Index lanes = 1;
    Agglomeration levels;
    Span<Real> vectors;        // [lanes x numbers of a lane]
    Span<Real> lane_history;   // [lanes x history]

    void lay_out(Arena& arena, Index n, Index functions, Iteration const& its_iteration, Executor const& its_executor) noexcept;
    // Are all diagonals positive? fault.item is a position otherwise.
    static Status check_diagonals(SymmetricRows const& rows, Fault& fault) noexcept;
    static Status refuse_row(Index position, Fault& fault) noexcept;
    // The largest residual of a lane's functions; several blocks of a lane pass the same iteration.
    void note(Index lane, Index its_iteration, Real residual) const noexcept;
    void tell_history() const noexcept;
};

}  // namespace harmorph
