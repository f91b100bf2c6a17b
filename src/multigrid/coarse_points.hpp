// The levels of the engine multigrid: each coarser one has some of the points of the finer one.
#pragma once

#include "multigrid/point_selection.hpp"
#include "multigrid/prolongation.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// Each level has at most half of the points of the finer one, but the first coarse level may have
// 9/16 of all n points, so that all coarse levels together have at most 9/8 n points. A row of a
// prolongation has one weight for a coarse point and at most four for a fine point, and room for
// four while the level is made; so the prolongations need room for 4 n weights and one for each
// point of a coarse level. The entries of all coarse matrices share an array of fixed size, of
// which a level may take two thirds of the rest. A level that needs more is interpolated with fewer
// weights for each point. With one weight, a level has at most as many entries as the finer one. If
// even this does not fit, no coarser level is made.
struct CoarsePoints {
    static constexpr Index max_levels = 20;
    // A level of so many points or fewer needs no coarser one.
    static constexpr Index coarsest = 48;
    static constexpr Index entries_per_point = 7;

    Index count = 0;
    SymmetricRows finest;            // The caller's arrays: level 0.
    CoarseRows coarse[max_levels];   // The levels from 1 on.
    Prolongation finer[max_levels];  // The interpolation from level l + 1 to level l.

    // The largest number of points of the first coarse level, and of all coarse levels.
    static Index most_first(Index n) noexcept { return n / 2 + n / 16; }
    static Offset coarse_points(Index n) noexcept { return Offset{2} * most_first(n); }

    // entries: those of the finest level.
    void lay_out(Arena& arena, Index n, Offset entries) noexcept;
    // Lays out the working space of build().
    void lay_out_work(Arena& arena, Index n, Offset entries) noexcept;
    // levels: the largest number of levels; 0 means no limit.
    void build(SymmetricRows const& rows, Index levels) noexcept;

    Index n(Index level) const noexcept { return level == 0 ? finest.n : coarse[level].n; }
    Offset entries(Index level) const noexcept {
        return level == 0 ? finest.entries() : coarse[level].entries();
    }
    // Calls body(rows of the level).
    template <class Body>
    auto visit(Index level, Body const& body) const noexcept {
        return level == 0 ? body(finest) : body(coarse[level]);
    }

private:
    static Offset weight_room(Index n) noexcept {
        return Offset{Prolongation::most_weights} * n + coarse_points(n);
    }
    static Offset entry_room(Index n) noexcept {
        return Offset{entries_per_point} * n + coarsest * coarsest;
    }
    bool add_level() noexcept;

    // The levels follow each other in these arrays.
    CoarseRows pool_;
    Prolongation weight_pool_;
    Offset points_used_ = 0, entries_used_ = 0, starts_used_ = 0, weights_used_ = 0;

    PointSelection selection_;
    Contraction contraction_;
};

}  // namespace harmorph
