#include "multigrid/point_selection.hpp"

namespace harmorph {

void FullRows::lay_out(Arena& arena, Index rows, Offset entries) noexcept {
    arena.take(row_sum, rows);
    arena.take(strongest, rows);
    arena.take(start_, Offset{rows} + 1);
    arena.take(column_, entries);
    arena.take(value_, entries);
}

void FullRows::find_strongest() noexcept {
    for (Index i = 0; i < n; ++i) {
        strongest[i] = 0;
        for_each(i, [&](Index, Real entry) { strongest[i] = max(strongest[i], -entry); });
    }
}

void PointSelection::lay_out(Arena& arena, Index n) noexcept {
    arena.take(weight_, n);
    arena.take(next_, n);
    arena.take(previous_, n);
}

void PointSelection::insert(Index point) noexcept {
    Index const list = min(weight_[point], lists - 1);
    Index const after = first_[list];
    next_[point] = after;
    previous_[point] = none;
    if (after != none) previous_[after] = point;
    first_[list] = point;
    heaviest_ = max(heaviest_, list);
}

void PointSelection::remove(Index point) noexcept {
    Index const before = previous_[point], after = next_[point];
    (before != none ? next_[before] : first_[min(weight_[point], lists - 1)]) = after;
    if (after != none) previous_[after] = before;
}

void PointSelection::change_weight(Index point, Index by) noexcept {
    remove(point);
    weight_[point] += by;
    insert(point);
}

Index PointSelection::select(FullRows const& rows, Index most, Span<Index> coarse) noexcept {
    for (Index& list : first_) list = none;
    heaviest_ = 0;
    for (Index i = rows.n - 1; i >= 0; --i) {
        coarse[i] = undecided;
        weight_[i] = 0;
        rows.for_each(i, [&](Index j, Real entry) { weight_[i] += rows.depends(j, i, entry); });
        insert(i);
    }
    while (heaviest_ >= 0) {
        Index const i = first_[heaviest_];
        if (i == none) {
            --heaviest_;
            continue;
        }
        remove(i);
        bool const is_needed = rows.any(i, [&](Index j, Real entry) {
            return coarse[j] == undecided && rows.depends(j, i, entry);
        });
        if (is_needed) {
            choose(rows, coarse, i);
        } else {
            leave(rows, coarse, i);
        }
    }
    Index n = 0;
    for (Index i = 0; i < rows.n; ++i) n += coarse[i] != none;
    add_common_points(rows, most - n, coarse);
    n = 0;
    for (Index i = 0; i < rows.n; ++i)
        if (coarse[i] != none) coarse[i] = n++;
    return n;
}

// Makes a coarse point, and fine points of the points that depend on it.
void PointSelection::choose(FullRows const& rows, Span<Index> coarse, Index point) noexcept {
    coarse[point] = 0;
    rows.for_each(point, [&](Index j, Real entry) {
        if (coarse[j] != undecided || !rows.depends(j, point, entry)) return;
        remove(j);
        leave(rows, coarse, j);
    });
    rows.for_each(point, [&](Index j, Real entry) {
        if (coarse[j] == undecided && rows.depends(point, j, entry)) change_weight(j, -1);
    });
}

// Makes a fine point; the points on which it depends are needed more.
void PointSelection::leave(FullRows const& rows, Span<Index> coarse, Index point) noexcept {
    coarse[point] = none;
    rows.for_each(point, [&](Index j, Real entry) {
        if (coarse[j] == undecided && rows.depends(point, j, entry)) change_weight(j, 1);
    });
}

// The second pass, which makes at most `count` coarse points.
void PointSelection::add_common_points(FullRows const& rows, Index count,
                                       Span<Index> coarse) noexcept {
    fill(next_.first(rows.n), none);
    for (Index i = 0; i < rows.n && count > 0; ++i) {
        if (coarse[i] != none) continue;
        Index const lonely = find_lonely(rows, coarse, i);
        if (lonely == none) continue;
        coarse[lonely] = 0;
        --count;
    }
}

// Returns a fine point on which this fine point depends, and which depends on no coarse point on
// which this one depends: the point itself if there are two such points, none if there is none.
// next_[j] is the last fine point found to depend on the coarse point j.
Index PointSelection::find_lonely(FullRows const& rows, Span<const Index> coarse,
                                  Index point) noexcept {
    auto const for_couplings = [&](Index i, auto const& visit) {
        rows.any(i, [&](Index j, Real entry) { return rows.depends(i, j, entry) && !visit(j); });
    };
    for_couplings(point, [&](Index j) {
        if (coarse[j] != none) next_[j] = point;
        return true;
    });
    Index lonely = none;
    for_couplings(point, [&](Index j) {
        if (coarse[j] != none) return true;
        bool shares = false;
        for_couplings(j, [&](Index k) {
            shares = next_[k] == point;
            return !shares;
        });
        if (shares) return true;
        bool const is_second = lonely != none;
        lonely = is_second ? point : j;
        next_[j] = point;
        return !is_second;
    });
    return lonely;
}

}  // namespace harmorph
