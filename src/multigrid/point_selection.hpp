// Selects the points of the next coarser level. Source: J. W. Ruge, K. Stueben, Algebraic
// multigrid, in: S. F. McCormick (ed.), Multigrid Methods, SIAM (1987), section 4.6.
#pragma once

#include "base/arena.hpp"
#include "base/scalar.hpp"
#include "base/sort.hpp"

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

}  // namespace harmorph
