#include "multigrid/coarse_points.hpp"

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

namespace {

constexpr Offset row_begin(Index row) noexcept { return Offset{Prolongation::most_weights} * row; }

}  // namespace

void Contraction::lay_out(Arena& arena, Index n, Offset entries) noexcept {
    rows.lay_out(arena, n, entries);
    arena.take(coarse, n);
    arena.take(deficit_, n);
    arena.take(part_, n);
    arena.take(coarse_sum_, n);
}

void Contraction::lay_out_interpolation(Arena& arena, Index n) noexcept {
    arena.take(candidates_, n);
    arena.take(of_, n);
}

void Contraction::lay_out_product(Arena& arena, Index n) noexcept {
    arena.take(first_, Offset{n} + 1);
    arena.take(fine_, Offset{Prolongation::most_weights} * n);
    arena.take(last_, n);
}

// Until the gaps are closed, row i begins at `most_weights` times i, and `none` ends a shorter row.
Offset Contraction::interpolate(Index most, Prolongation const& to) noexcept {
    for (Index i = 0; i < rows.n; ++i) {
        deficit_[i] = coarse[i] != none ? 0 : 1;
        Offset const begin = row_begin(i);
        to.column[begin] = coarse[i];
        to.weight[begin] = 1;
        to.column[begin + 1] = none;
    }
    auto const for_fine_points = [&](auto const& visit) {
        fill(of_.first(rows.n), none);
        for (Index i = 0; i < rows.n; ++i)
            if (coarse[i] == none) visit(i);
    };
    for_fine_points([&](Index i) { weigh(i, most, to); });
    for_fine_points([&](Index i) { relax(i, most, to); });
    return close_gaps(to);
}

// The value of a fine point follows from its row with the residual 0. Entries that lead to no
// candidate are moved to the diagonal, except that the entries of other fine points on which it
// depends are distributed among the candidates and itself.
void Contraction::weigh(Index point, Index most, Prolongation const& to) noexcept {
    gather_candidates(point);
    rows.for_each(point, [&](Index j, Real entry) {
        if (is_candidate(point, j)) {
            part_[coarse[j]] += entry;
        } else if (coarse[j] == none && rows.depends(point, j, entry)) {
            spread(point, j, entry);
        }
    });
    Choice choice;
    choose(most, choice);
    // This is the diagonal with the entries that were moved to it. It is exactly -choice.all if the
    // row sum is 0, so that constants are interpolated exactly.
    Real const diagonal = rows.row_sum[point] - choice.all;
    if (diagonal > 0 && choice.is_sound()) {
        put(point, choice, choice.count, rows.row_sum[point] / diagonal, to);
    } else if (choice.count > 0) {
        put(point, choice, 1, 0, to);
    }
}

void Contraction::gather_candidates(Index point) noexcept {
    n_candidates_ = 0;
    rows.for_each(point, [&](Index j, Real entry) {
        if (!rows.depends(point, j, entry)) return;
        if (coarse[j] != none) return add_candidate(point, coarse[j]);
        rows.for_each(j, [&](Index k, Real next) {
            if (coarse[k] != none && rows.depends(j, k, next)) add_candidate(point, coarse[k]);
        });
    });
}

void Contraction::add_candidate(Index point, Index column) noexcept {
    if (of_[column] == point) return;
    of_[column] = point;
    part_[column] = 0;
    candidates_[n_candidates_++] = column;
}

// Distributes an entry of a point in the column of the fine point `over` in proportion to the
// negative entries of `over`.
void Contraction::spread(Index point, Index over, Real entry) noexcept {
    Real all = 0;
    auto const for_each = [&](auto const& visit) {
        rows.for_each(over, [&](Index j, Real share) {
            if (share < 0 && (j == point || is_candidate(point, j))) visit(j, share);
        });
    };
    for_each([&](Index, Real share) { all += share; });
    for_each([&](Index j, Real share) {
        if (j != point) part_[coarse[j]] += entry * (share / all);
    });
}

// Makes the residual of the row of a fine point 0, where its neighbours are interpolated as they
// are now. Neighbours without weights are moved to the diagonal.
void Contraction::relax(Index point, Index most, Prolongation const& to) noexcept {
    n_candidates_ = 0;
    Real diagonal = rows.row_sum[point], deficit = diagonal;
    rows.for_each(point, [&](Index j, Real entry) {
        Offset const begin = row_begin(j);
        if (to.column[begin] == none) return;
        diagonal -= entry;
        deficit -= entry * deficit_[j];
        for (Offset f = begin; f < begin + Prolongation::most_weights && to.column[f] != none;
             ++f) {
            add_candidate(point, to.column[f]);
            part_[to.column[f]] += entry * to.weight[f];
        }
    });
    Choice choice;
    choose(most, choice);
    if (diagonal > 0 && choice.is_sound())
        put(point, choice, choice.count, clamp(deficit / diagonal, 0.0, 1.0), to);
}

// The choice is an argument, because g++ 11 at -O3 warns that a returned choice may have no values.
void Contraction::choose(Index most, Choice& out) const noexcept {
    Weight* const weights = out.weights;
    for (Index c = 0; c < n_candidates_; ++c) {
        Index const column = candidates_[c];
        Real const part = part_[column];
        out.all += part;
        Index k = out.count < most ? out.count++ : most;
        for (; k > 0 && abs(part) > abs(weights[k - 1].value); --k)
            if (k < most) weights[k] = weights[k - 1];
        if (k < most) weights[k] = {column, part};
    }
    while (out.count > 0 && abs(weights[out.count - 1].value) <
                                Prolongation::smallest_weight * abs(weights[0].value))
        --out.count;
    for (Index k = 0; k < out.count; ++k) out.kept += weights[k].value;
}

// Writes the row of a fine point: `count` weights of the choice, in proportion to their parts.
void Contraction::put(Index point, Choice const& choice, Index count, Real deficit,
                      Prolongation const& to) noexcept {
    deficit_[point] = deficit;
    Real const kept = count == 1 ? choice.weights[0].value : choice.kept;
    Offset const begin = row_begin(point);
    for (Index k = 0; k < count; ++k) {
        to.column[begin + k] = choice.weights[k].column;
        to.weight[begin + k] = choice.weights[k].value * ((1 - deficit) / kept);
    }
    if (count < Prolongation::most_weights) to.column[begin + count] = none;
}

Offset Contraction::close_gaps(Prolongation const& to) const noexcept {
    Offset used = 0;
    for (Index i = 0; i < rows.n; ++i) {
        to.start[i] = used;
        Offset const begin = row_begin(i);
        for (Offset e = begin; e < begin + Prolongation::most_weights && to.column[e] != none;
             ++e) {
            to.column[used] = to.column[e];
            to.weight[used++] = to.weight[e];
        }
    }
    to.start[rows.n] = used;
    return used;
}

void Contraction::transpose(Prolongation const& by, Index n) noexcept {
    Span<Offset> const starts = first_.first(n + 1);
    fill(starts, Offset{0});
    Offset const count = by.start[rows.n];
    for (Offset e = 0; e < count; ++e) ++starts[by.column[e]];
    counts_to_starts(starts);
    for (Index i = 0; i < rows.n; ++i) {
        for (Offset e = by.start[i]; e < by.start[i + 1]; ++e) fine_[starts[by.column[e]]++] = i;
    }
    rewind_starts(starts);
}

bool Contraction::contract(Prolongation const& by, Offset room, CoarseRows& result) noexcept {
    Index const n = result.n;
    transpose(by, n);
    contract_row_sums(by, n);
    fill(last_.first(n), Offset{-1});
    // The row under construction is summed in double precision.
    Span<Real> const row = part_;
    Offset used = 0;
    for (Index c = 0; c < n; ++c) {
        Offset const begin = used;
        auto const add = [&](Index fine, Real factor) {
            for (Offset e = by.start[fine]; e < by.start[fine + 1]; ++e) {
                Index const to = by.column[e];
                if (to <= c) continue;
                if (last_[to] < begin) {
                    if (used == room) return false;
                    last_[to] = used;
                    result.column[used] = to;
                    row[used++ - begin] = 0;
                }
                row[last_[to] - begin] += factor * by.weight[e];
            }
            return true;
        };
        for (Offset t = first_[c]; t < first_[c + 1]; ++t) {
            Index const i = fine_[t];
            Real const weight = by.at(i, c);
            if (!add(i, weight * rows.diagonal[i])) return false;
            bool const overflows =
                rows.any(i, [&](Index j, Real entry) { return !add(j, weight * entry); });
            if (overflows) return false;
        }
        result.start[c] = begin;
        for (Offset e = begin; e < used; ++e) result.value[e] = row[e - begin];
    }
    result.start[n] = used;
    for (Index c = 0; c < n; ++c) result.diagonal[c] = coarse_sum_[c];
    for (Index c = 0; c < n; ++c) {
        for (Offset e = result.start[c]; e < result.start[c + 1]; ++e) {
            result.diagonal[c] -= result.value[e];
            result.diagonal[result.column[e]] -= result.value[e];
        }
    }
    for (Index c = 0; c < n; ++c)
        if (!(result.diagonal[c] > 0)) return false;
    return true;
}

// The row sums of P^T A P are P^T A s, where s has the sums of the rows of P. A s is a sum of
// flows, so small row sums are not lost in the rounding of large entries.
void Contraction::contract_row_sums(Prolongation const& by, Index n) noexcept {
    fill(coarse_sum_.first(n), 0.0);
    for (Index i = 0; i < rows.n; ++i) {
        Real flow = rows.row_sum[i] * (1 - deficit_[i]);
        rows.for_each(i, [&](Index j, Real entry) { flow += entry * (deficit_[i] - deficit_[j]); });
        for (Offset e = by.start[i]; e < by.start[i + 1]; ++e)
            coarse_sum_[by.column[e]] += by.weight[e] * flow;
    }
}

void Contraction::descend(CoarseRows const& result) noexcept {
    copy(rows.row_sum.first(result.n), Span<const Real>(coarse_sum_.first(result.n)));
    rows.strong = FullRows::strong_on_coarse_levels;
    rows.take(result);
}

void CoarsePoints::lay_out(Arena& arena, Index n, Offset entries) noexcept {
    arena.take(pool_.diagonal, coarse_points(n));
    arena.take(pool_.start, coarse_points(n) + max_levels);
    arena.take(pool_.column, entry_room(n));
    // In single precision, the entries of all levels take no more memory than this.
    arena.take(pool_.value, max(entry_room(n), (entry_room(n) + entries + 1) / 2));
    arena.take(weight_pool_.start, n + coarse_points(n) + max_levels);
    arena.take(weight_pool_.column, weight_room(n));
    arena.take(weight_pool_.weight, weight_room(n));
}

void CoarsePoints::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    contraction_.lay_out(arena, n, max(entries, 2 * entry_room(n) / 3));
    // A level is made in three steps, whose working spaces share their memory.
    auto const shared = arena.mark();
    selection_.lay_out(arena, n);
    arena.release(shared);
    contraction_.lay_out_interpolation(arena, n);
    arena.release(shared);
    contraction_.lay_out_product(arena, n);
}

void CoarsePoints::build(SymmetricRows const& rows, Index levels) noexcept {
    count = 1;
    finest = rows;
    points_used_ = entries_used_ = starts_used_ = weights_used_ = 0;
    Index const max_count = levels == 0 ? max_levels : min(levels, max_levels);
    copy(contraction_.rows.row_sum, Span<const Real>(rows.row_sum));
    contraction_.rows.strong = FullRows::strong_on_finest_level;
    contraction_.rows.take(rows);
    while (count < max_count && n(count - 1) > coarsest && add_level()) {}
}

bool CoarsePoints::add_level() noexcept {
    Index const n_fine = n(count - 1);
    Offset const room = 2 * (entry_room(finest.n) - entries_used_) / 3;
    CoarseRows& made = coarse[count];
    Index const most = count == 1 ? most_first(finest.n) : 0;
    made.n = selection_.select(contraction_.rows, most, contraction_.coarse);
    if (made.n == 0) return false;
    made.diagonal = pool_.diagonal.from(points_used_, made.n);
    made.start = pool_.start.from(points_used_ + count - 1, made.n + 1);
    made.column = pool_.column.from(entries_used_, room);
    made.value = pool_.value.from(entries_used_, room);
    Prolongation& by = finer[count - 1];
    by.start = weight_pool_.start.from(starts_used_, n_fine + 1);
    Offset const weights_left = weight_room(finest.n) - weights_used_;
    by.column = weight_pool_.column.from(weights_used_, weights_left);
    by.weight = weight_pool_.weight.from(weights_used_, weights_left);
    Index width = Prolongation::most_weights;
    Offset weights = contraction_.interpolate(width, by);
    while (!contraction_.contract(by, room, made)) {
        if (--width == 0) return false;
        weights = contraction_.interpolate(width, by);
    }
    contraction_.descend(made);
    points_used_ += made.n;
    entries_used_ += made.entries();
    starts_used_ += n_fine + 1;
    weights_used_ += weights;
    ++count;
    return true;
}

}  // namespace harmorph
