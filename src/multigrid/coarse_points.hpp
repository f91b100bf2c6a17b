// The levels of the engine multigrid: each coarser one has some of the points of the finer one.
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"
#include "base/sort.hpp"
#include "operators/symmetric_matrix.hpp"

namespace harmorph {

// The rows of a level: the symmetric matrix of a coarse level, of which one triangle is stored, and
// whole rows of one level, which the coarsening reads.

// Row i stores the entries in later columns. The diagonal is the row sum minus all entries of the
// row. Entries are in double precision, as in sheared thin cells large entries cancel when a stack
// of cells moves as one.
struct CoarseRows {
    Index n = 0;
    Span<Real> diagonal;  // [n]
    Span<Offset> start;   // [n + 1]
    Span<Index> column;
    Span<Real> value;

    Offset entries() const noexcept { return start[n]; }
};

struct FullRows {
    // A coupling is strong for a point if its size is at least this fraction of the strongest one.
    // Coarse levels, whose rows have more and smaller entries, have a fraction of their own.
    static constexpr Real strong_on_finest_level = 0.25, strong_on_coarse_levels = 0.1;

    Real strong = strong_on_finest_level;
    Index n = 0;
    Span<const Real> diagonal;  // [n] That of the triangle.
    Span<Real> row_sum;         // [n]
    Span<Real> strongest;       // [n] The size of the strongest coupling of each point.

    // entries: the number of entries of one triangle.
    void lay_out(Arena& arena, Index rows, Offset entries) noexcept;
    // Takes the upper triangle, which is viewed, and stores the entries of the lower one that are
    // not 0; row_sum must have been set.
    template <class HalfRows>
    void take(HalfRows const& half) noexcept;

    // Calls visit(column, entry) for the entries of a row that are not 0, those of the lower
    // triangle first, until this returns true; tells whether it did.
    template <class Visit>
    bool any(Index i, Visit const& visit) const noexcept {
        for (Offset e = start_[i]; e < start_[i + 1]; ++e)
            if (visit(column_[e], value_[e])) return true;
        for (Offset e = upper_.start[i]; e < upper_.start[i + 1]; ++e)
            if (upper_.value[e] != 0 && visit(upper_.column[e], upper_.value[e])) return true;
        return false;
    }
    // Calls visit(column, entry) for all entries of a row that are not 0.
    template <class Visit>
    void for_each(Index i, Visit const& visit) const noexcept {
        any(i, [&](Index j, Real entry) {
            visit(j, entry);
            return false;
        });
    }

    // Tells whether point i depends strongly on point j, with the entry of both. Only negative
    // entries, which make values similar, are strong. The strongest coupling of j is strong for i,
    // too: if couplings grow along a row of points by more than 1 / strong, points would otherwise
    // be interpolated from one side only, and the coarse level would be too stiff.
    bool depends(Index i, Index j, Real entry) const noexcept {
        return entry < 0 && (-entry >= strong * strongest[i] || -entry >= strongest[j]);
    }

private:
    void find_strongest() noexcept;

    // The lower triangle.
    Span<Offset> start_;  // [n + 1]
    Span<Index> column_;
    Span<Real> value_;
    struct {
        Span<const Offset> start;
        Span<const Index> column;
        Span<const Real> value;
    } upper_;
};

template <class HalfRows>
void FullRows::take(HalfRows const& half) noexcept {
    n = half.n;
    diagonal = half.diagonal;
    upper_ = {half.start, half.column, half.value};
    Span<Offset> const starts = start_.first(n + 1);
    fill(starts, Offset{0});
    auto const for_entries = [&](auto const& visit) {
        for (Index i = 0; i < n; ++i) {
            for (Offset e = half.start[i]; e < half.start[i + 1]; ++e) {
                if (half.value[e] != 0) visit(i, half.column[e], half.value[e]);
            }
        }
    };
    for_entries([&](Index, Index j, Real) { ++starts[j]; });
    counts_to_starts(starts);
    for_entries([&](Index i, Index j, Real entry) {
        column_[starts[j]] = i;
        value_[starts[j]++] = entry;
    });
    rewind_starts(starts);
    find_strongest();
}

// Selects the points of the next coarser level. Source: J. W. Ruge, K. Stueben, Algebraic
// multigrid, in: S. F. McCormick (ed.), Multigrid Methods, SIAM (1987), section 4.6.
//
// First pass: the point on which most undecided points depend strongly becomes a coarse point, and
// these points become fine points. Unlike in the source, a point on which no undecided point
// depends becomes a fine point. Each coarse point thereby makes a fine point: at most half of the
// points become coarse points. Second pass, for the first coarse level: of two fine points, one of
// which depends on the other one, both depend on the same coarse point; otherwise one of them
// becomes a coarse point. Fine points are interpolated from coarse points at a distance of one or
// two couplings, so levels can do without the second pass, but converge more slowly on stretched
// triangles.
class PointSelection {
public:
    void lay_out(Arena& arena, Index n) noexcept;
    // coarse [rows.n] receives the numbers of the coarse points on the coarser level, in the order
    // of the rows, and none for fine points. The second pass ends when there are `most` coarse
    // points; 0 means no second pass. Returns the number of coarse points.
    Index select(FullRows const& rows, Index most, Span<Index> coarse) noexcept;

private:
    // Undecided points are in the list of their weight; larger weights share the last list.
    static constexpr Index lists = 64;
    static constexpr Index undecided = -2;

    void insert(Index point) noexcept;
    void remove(Index point) noexcept;
    void change_weight(Index point, Index by) noexcept;
    void choose(FullRows const& rows, Span<Index> coarse, Index point) noexcept;
    void leave(FullRows const& rows, Span<Index> coarse, Index point) noexcept;
    void add_common_points(FullRows const& rows, Index count, Span<Index> coarse) noexcept;
    Index find_lonely(FullRows const& rows, Span<const Index> coarse, Index point) noexcept;

    Span<Index> weight_, next_, previous_;  // [n]
    Index first_[lists];
    Index heaviest_ = 0;  // No list behind this one has points.
};

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
    void choose(Index most, Choice& out) const noexcept;
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
