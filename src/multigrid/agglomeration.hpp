// Coarser levels of a mesh: dual control volumes are merged (agglomeration), and their conductances
// are added.
#pragma once

#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// The rule that chooses the cells to merge. In cells of aspect ratio a conductances differ by a
// factor of a^2, and a smoother reduces errors only along strong couplings. `isotropic` merges with
// the neighbour with most common mesh edges, whatever the conductances. `directional` merges with
// the neighbour with the largest conductance (semi-coarsening). `automatic` is directional where
// the aspect ratio exceeds 2, and isotropic among the strong neighbours elsewhere.
enum class Merging : std::int32_t { automatic = 0, isotropic = 1, directional = 2 };

struct MergingRules {
    Merging merging = Merging::automatic;
    Index max_levels = 0;  // The finest level is included; 0 means no limit.
};

// Cells are merged in the order of their numbers, which should be that of an advancing front
// (order_by_layers). A coarse level takes two passes. In each pass, a cell that is not yet merged
// is paired with the preferred one of its later neighbours that are not yet merged; if no such
// neighbour is coupled strongly enough, the cell joins the pair of its strongest neighbour. Except
// with isotropic merging, cells are not merged if the smoother of the finer level could not make
// their values equal. A merged cell has at most `max_members` cells of a pass, so at most the
// square of that number of cells of the finer level. Only cells that share a mesh edge are merged.
// Merged cells are therefore connected, and the graph of a coarse level is planar except for two
// diagonals in each quad, with at most `max_couplings` for each cell. No coarser level is made that
// would have more couplings, or more cells than 1 / min_reduction of the finer level, so that all
// coarse levels together fit in the memory that lay_out() takes.
struct Agglomeration {
    static constexpr Index max_levels = 20;  // 3^19 is larger than 2^30.
    static constexpr Index max_members = 4;
    static constexpr Index min_reduction = 3;
    static constexpr Index max_couplings = 4;
    // A level of so many unknowns or fewer needs no coarser one.
    static constexpr Index coarsest = 48;

    Index count = 0;
    SymmetricRows level[max_levels];  // The finest level, level[0], has the caller's arrays.
    Span<Index> cell_of[max_levels];  // [n] The merged cell of the next coarser level.

    Index n(Index l) const noexcept { return level[l].n; }
    Offset entries(Index l) const noexcept { return level[l].entries(); }

    // Returns an upper bound of the number of cells of all coarse levels together.
    static Offset coarse_cells(Index n) noexcept { return n / (min_reduction - 1); }

    // The sums of the diagonals and of the row sums of a cell, or of several cells that are to be
    // merged.
    struct CellSums {
        Real diagonal = 0;
        Real row_sum = 0;

        void operator+=(CellSums const& more) noexcept {
            diagonal += more.diagonal;
            row_sum += more.row_sum;
        }
    };

    void lay_out(Arena& arena, Index n) noexcept;
    // Lays out the working space of build().
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    void build(SymmetricRows const& finest, MergingRules const& rules) noexcept;

private:
    bool add_level(Merging merging) noexcept;
    // The unmerged neighbour with which a cell forms a pair, and the merged neighbour whose cell it
    // may join otherwise; both may be none.
    struct Neighbours {
        Index partner = none, host = none;
        Real host_coupling = 0;
    };
    Neighbours find_neighbours(SymmetricRows const& rows, Merging merging, Span<const Index> to,
                               Index i) const noexcept;
    Index pair_up(SymmetricRows const& rows, Merging merging, Span<Index> to) const noexcept;

    SymmetricRows pool_;     // The coarse levels follow each other in these arrays.
    Span<Index> cell_pool_;  // cell_of of all levels.
    Offset cells_used_ = 0, entries_used_ = 0, maps_used_ = 0;

    struct Work {
        SymmetricRows rows;
        Span<Index> first, second;    // [n] The maps of the two passes.
        Span<CellSums> sums;          // [n]
        Span<Real> strongest;         // [n] The strongest coupling of each cell.
        Span<Real> strongest_before;  // [n] The strongest coupling to an earlier cell.
        Span<Index> before;           // [n] The earlier cell of this coupling.
        Span<std::uint8_t> members;   // [n]
        Span<Offset> last;            // [n]
    };
    Work work_;
};

}  // namespace harmorph
