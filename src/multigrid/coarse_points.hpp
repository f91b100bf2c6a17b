// The levels of the engine multigrid: each coarser one has some of the points of the finer one.
#pragma once

#include "multigrid/point_selection.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// The interpolation from coarse points, and the matrix of the coarse points. Sources: H. De Sterck,
// R. D. Falgout, J. W. Nolting, U. M. Yang, Distance-two interpolation for parallel algebraic
// multigrid, Numer. Linear Algebra Appl. 15 (2008) 115: formula "extended+i"; K. Stueben, A review
// of algebraic multigrid, J. Comput. Appl. Math. 128 (2001) 281: interpolation that is improved by
// relaxation of the fine points.

// Row i has the weights of the coarse points from which point i is interpolated; a coarse point has
// itself with the weight 1, a fine point that depends on nothing has no weight.
struct Prolongation {
    static constexpr Index most_weights = 4;  // of a row
    // A weight of a row is at least this fraction of the largest one.
    static constexpr Real smallest_weight = 0.15;

    Span<Offset> start;  // [n + 1]
    Span<Index> column;
    Span<Real> weight;

    // Returns the weight of a coarse point that the row contains.
    Real at(Index row, Index coarse) const noexcept {
        Offset e = start[row];
        while (column[e] != coarse) ++e;
        return weight[e];
    }
};

// The working space with which interpolate() and contract() make the next level.
class Contraction {
public:
    FullRows rows;       // the finer level
    Span<Index> coarse;  // [n] The numbers of the coarse points, and none for fine points.

    // entries: the largest number of entries of one triangle of a finer level. The working spaces
    // of interpolate() and of contract() may occupy the same memory.
    void lay_out(Arena& arena, Index n, Offset entries) noexcept;
    void lay_out_interpolation(Arena& arena, Index n) noexcept;
    void lay_out_product(Arena& arena, Index n) noexcept;

    // Fills the rows of `to`, each with at most `most` weights: by the formula "extended+i", and
    // then by one relaxation. The largest weights are kept, and scaled to the sum of all. Returns
    // the number of weights. `to` has room for Prolongation::most_weights in each row.
    Offset interpolate(Index most, Prolongation const& to) noexcept;
    // Computes result = P^T rows P. result.n is given; result.column and result.value have room for
    // `room` entries. Returns false if there are more, or if a diagonal is not positive.
    bool contract(Prolongation const& by, Offset room, CoarseRows& result) noexcept;
    // Makes the result of contract() the finer level.
    void descend(CoarseRows const& result) noexcept;

private:
    struct Weight {
        Index column;
        Real value;
    };
    // The candidates of a fine point that are kept, the largest one first.
    struct Choice {
        Weight weights[Prolongation::most_weights];
        Index count = 0;
        Real all = 0, kept = 0;  // The sums of the parts of all candidates, and of these.

        // Returns whether these parts stand for all of them.
        bool is_sound() const noexcept { return all < 0 && kept < 0.1 * all; }
    };

    void weigh(Index point, Index most, Prolongation const& to) noexcept;
    void gather_candidates(Index point) noexcept;
    void spread(Index point, Index over, Real entry) noexcept;
    void relax(Index point, Index most, Prolongation const& to) noexcept;
    void add_candidate(Index point, Index column) noexcept;
    Choice choose(Index most) const noexcept;
    void put(Index point, Choice const& choice, Index count, Real deficit,
             Prolongation const& to) noexcept;
    Offset close_gaps(Prolongation const& to) const noexcept;
    bool is_candidate(Index point, Index neighbour) const noexcept {
        return coarse[neighbour] != none && of_[coarse[neighbour]] == point;
    }
    void transpose(Prolongation const& by, Index n) noexcept;
    void contract_row_sums(Prolongation const& by, Index n) noexcept;

    // [n] 1 - the sum of the weights of each point, which is 0 or small away from known values, and
    // accurate however small it is.
    Span<Real> deficit_;
    Span<Index> candidates_;  // [n] The coarse points round a fine point.
    Index n_candidates_ = 0;
    Span<Index> of_;   // [n] The fine point for which a coarse point is a candidate.
    Span<Real> part_;  // [n] The part of the row of a fine point that falls on a candidate.
    // The pattern of the transpose of the prolongation.
    Span<Offset> first_;     // [n + 1]
    Span<Index> fine_;       // [most_weights n]
    Span<Real> coarse_sum_;  // [n] The row sums of the result.
    Span<Offset> last_;      // [n]
};

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

    // entries: the number of entries of the finest level.
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
