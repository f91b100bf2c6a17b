// The interpolation from coarse points, and the matrix of the coarse points. Sources: H. De Sterck,
// R. D. Falgout, J. W. Nolting, U. M. Yang, Distance-two interpolation for parallel algebraic
// multigrid, Numer. Linear Algebra Appl. 15 (2008) 115: formula "extended+i"; K. Stueben, A review
// of algebraic multigrid, J. Comput. Appl. Math. 128 (2001) 281: interpolation that is improved by
// relaxation of the fine points.
#pragma once

#include "multigrid/coarse_rows.hpp"

namespace harmorph {

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

}  // namespace harmorph
