// Coarser levels of a mesh by merging its dual control volumes (agglomeration), and the sums of their conductances.
#pragma once

#include "harmorph/operators/symmetric_matrix.hpp"

namespace harmorph {

// What is merged. Cells of aspect ratio a have conductances in the ratio a^2, and only what is strongly coupled is smoothed
// alike. isotropic: cells with most mesh edges between them, whatever the conductances. directional: those with the largest
// conductance. automatic: directional where the aspect ratio exceeds 2, isotropic among the strong neighbours elsewhere.
enum class Merging : std::int32_t { automatic = 0, isotropic = 1, directional = 2 };

struct MergingRules {
    Merging merging = Merging::automatic;
    Index max_levels = 0;  // with the finest; 0: as many as there are
};

// Rules. Cells are taken in their order, which should be that of an advancing front (order_by_layers). A level is made of
// two passes. In each, a cell that is still alone is paired with the preferred one of its later neighbours that are still
// alone; if none is coupled strongly enough, it joins the pair of its strongest neighbour. Neither happens, but with
// isotropic merging, where smoothing on the level below could not bring the two to one value. A merged cell has at most
// `most_members` cells of its pass, and so at most the square of that of its level. Only cells that share a mesh edge are
// merged, so that each stays connected, and merged graphs are planar but for two diagonals in each quad: at most
// `most_couplings` per cell. The levels end where a level would have more couplings, or more than 1 / least_reduction of
// the cells below it: so all the coarse levels fit in what lay_out() takes.
struct Agglomeration {
    static constexpr Index most_levels = 20;  // 3^19 > 2^30
    static constexpr Index most_members = 4;
    static constexpr Index least_reduction = 3;
    static constexpr Index most_couplings = 4;
    static constexpr Index coarsest = 48;     // unknowns that need no coarser level

    Index count = 0;
    SymmetricRows level[most_levels];         // the finest is the caller's
    Span<Index> cell_of[most_levels];         // [n] of each cell of a level: cell of the next coarser one

    // Cells of all coarse levels together.
    static Offset coarse_cells(Index n) noexcept { return n / (least_reduction - 1); }

    // What smoothing sees of a cell, or of several that are to have one value.
    struct Part {
        Real diagonal = 0;  // the sum of those of the level's cells
        Real row_sum = 0;

        void operator+=(Part const& more) noexcept {
            diagonal += more.diagonal;
            row_sum += more.row_sum;
        }
    };

    void lay_out(Arena& arena, Index n) noexcept;
    // Needed by build() alone.
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    void build(SymmetricRows const& finest, MergingRules const& rules) noexcept;

private:
    bool add_level(Merging merging) noexcept;
    Index pair_up(SymmetricRows const& rows, Merging merging, Span<Index> to) const noexcept;

    SymmetricRows pool_;    // the coarse levels, one behind the other
    Span<Index> cell_pool_; // cell_of of all levels
    Offset cells_used_ = 0, entries_used_ = 0, maps_used_ = 0;

    struct Work {
        SymmetricRows rows;
        Span<Index> first, second;    // [n] maps of the two passes
        Span<Part> parts;             // [n]
        Span<Real> strongest;         // [n] coupling of each cell
        Span<Real> strongest_before;  // [n] coupling to an earlier cell
        Span<Index> before;           // [n] that cell
        Span<std::uint8_t> members;   // [n]
        Span<Offset> last;            // [n]
    };
    Work work_;
};

}  // namespace harmorph
