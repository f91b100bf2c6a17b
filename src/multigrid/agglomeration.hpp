// Coarser levels of a mesh by merging its dual control volumes (agglomeration), and the sums of
// their conductances.
#pragma once

#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// Which cells are merged. In cells of aspect ratio a conductances differ by a factor of a^2, and a
// smoother reduces errors only along strong couplings. isotropic: the neighbour with most common
// mesh edges, whatever the conductances. directional: the neighbour with the largest conductance
// (semi-coarsening). automatic: directional where the aspect ratio exceeds 2, isotropic among the
// strong neighbours elsewhere.
enum class Merging : std::int32_t { automatic = 0, isotropic = 1, directional = 2 };

struct MergingRules {
    Merging merging = Merging::automatic;
    Index max_levels = 0;  // the finest one included; 0: no limit
};

// Rules. Cells are taken in the order of their numbers, which should be that of an advancing front
// (order_by_layers). A coarse level takes two passes. In each, a cell that is not yet merged is
// paired with the preferred one of its later neighbours that are not yet merged; if no such
// neighbour is coupled strongly enough, the cell joins the pair of its strongest neighbour. Except
// with isotropic merging, neither happens where the smoother of the finer level could not make the
// values of the two equal. A merged cell has at most `most_members` cells of a pass, so at most the
// square of that of the finer level. Only cells that share a mesh edge are merged, so merged cells
// are connected, and the graph of a coarse level is planar but for two diagonals in each quad: at
// most `most_couplings` for each cell. No coarser level is made that would have more couplings, or
// more cells than 1 / least_reduction of the finer level: so all coarse levels together fit in what
// lay_out() takes.
struct Agglomeration {
    static constexpr Index most_levels = 20;  // 3^19 > 2^30
    static constexpr Index most_members = 4;
    static constexpr Index least_reduction = 3;
    static constexpr Index most_couplings = 4;
    static constexpr Index coarsest =
        48;  // a level of so many unknowns or fewer needs no coarser one

    Index count = 0;
    SymmetricRows level[most_levels];  // level[0], the finest, has the caller's arrays
    Span<Index> cell_of[most_levels];  // [n] the merged cell of the next coarser level

    // Upper bound of the cells of all coarse levels together.
    static Offset coarse_cells(Index n) noexcept { return n / (least_reduction - 1); }

    // The diagonals and row sums of a cell, or of several that are to be merged.
    struct Part {
        Real diagonal = 0;
        Real row_sum = 0;

        void operator+=(Part const& more) noexcept {
            diagonal += more.diagonal;
            row_sum += more.row_sum;
        }
    };

    void lay_out(Arena& arena, Index n) noexcept;
    // Working space of build().
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    void build(SymmetricRows const& finest, MergingRules const& rules) noexcept;

private:
    bool add_level(Merging merging) noexcept;
    Index pair_up(SymmetricRows const& rows, Merging merging, Span<Index> to) const noexcept;

    SymmetricRows pool_;     // all coarse levels, one behind the other
    Span<Index> cell_pool_;  // cell_of of all levels
    Offset cells_used_ = 0, entries_used_ = 0, maps_used_ = 0;

    struct Work {
        SymmetricRows rows;
        Span<Index> first, second;    // [n] maps of the two passes
        Span<Part> parts;             // [n]
        Span<Real> strongest;         // [n] strongest coupling of each cell
        Span<Real> strongest_before;  // [n] strongest coupling to an earlier cell
        Span<Index> before;           // [n] that cell
        Span<std::uint8_t> members;   // [n]
        Span<Offset> last;            // [n]
    };
    Work work_;
};

}  // namespace harmorph
