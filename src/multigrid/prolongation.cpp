#include "multigrid/prolongation.hpp"

namespace harmorph {

void Contraction::lay_out(Arena& arena, Index n, Offset entries) noexcept {
    rows.lay_out(arena, n, entries);
    arena.take(coarse, n);
    arena.take(sum_, n);
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

Offset Contraction::interpolate(Index most, Prolongation const& to) noexcept {
    fill(of_.first(rows.n), none);
    Offset used = 0;
    for (Index i = 0; i < rows.n; ++i) {
        to.start[i] = used;
        Weight weights[Prolongation::most_weights];
        Index count = 1;
        if (coarse[i] != none) {
            weights[0] = {i, 1};
            sum_[i] = 1;
        } else {
            count = weigh(i, most, weights);
        }
        for (Index k = 0; k < count; ++k) {
            to.column[used] = coarse[weights[k].point];
            to.weight[used++] = weights[k].value;
        }
    }
    to.start[rows.n] = used;
    return used;
}

// The value of a fine point follows from its row with the residual 0. Entries that lead to no
// candidate are moved to the diagonal, except that the entries of other fine points on which it
// depends are distributed among the candidates and itself.
Index Contraction::weigh(Index point, Index most, Weight* weights) noexcept {
    gather_candidates(point);
    for (Offset e = rows.start[point]; e < rows.start[point + 1]; ++e) {
        Index const j = rows.column[e];
        if (of_[j] == point) {
            part_[j] += rows.value[e];
        } else if (coarse[j] == none && rows.depends(point, rows.column[e], rows.value[e])) {
            spread(point, j, rows.value[e]);
        }
    }
    Real all = 0, kept = 0;
    Index count = 0;
    for (Index c = 0; c < n_candidates_; ++c) {
        Index const j = candidates_[c];
        Real const part = part_[j];
        all += part;
        Index k = count < most ? count++ : most;
        for (; k > 0 && abs(part) > abs(weights[k - 1].value); --k)
            if (k < most) weights[k] = weights[k - 1];
        if (k < most) weights[k] = {j, part};
    }
    for (Index k = 0; k < count; ++k) kept += weights[k].value;
    // This is the diagonal with the entries that were moved to it: exactly -all if the row sum is
    // 0, so that constants are interpolated exactly.
    Real const diagonal = rows.row_sum[point] - all;
    constexpr Real smallest = 0.1;
    bool const is_sound = diagonal > 0 && kept < smallest * all;
    sum_[point] = is_sound ? -all / diagonal : min(count, Index{1});
    if (!is_sound) {
        count = min(count, Index{1});
        kept = count > 0 ? weights[0].value : 1;
    }
    for (Index k = 0; k < count; ++k) weights[k].value *= sum_[point] / kept;
    return count;
}

void Contraction::gather_candidates(Index point) noexcept {
    n_candidates_ = 0;
    auto const add = [&](Index j) {
        if (of_[j] == point) return;
        of_[j] = point;
        part_[j] = 0;
        candidates_[n_candidates_++] = j;
    };
    for (Offset e = rows.start[point]; e < rows.start[point + 1]; ++e) {
        if (!rows.depends(point, rows.column[e], rows.value[e])) continue;
        Index const j = rows.column[e];
        if (coarse[j] != none) {
            add(j);
            continue;
        }
        for (Offset f = rows.start[j]; f < rows.start[j + 1]; ++f)
            if (coarse[rows.column[f]] != none && rows.depends(j, rows.column[f], rows.value[f]))
                add(rows.column[f]);
    }
}

// Distributes an entry of a point in the column of the fine point `over` in proportion to the
// negative entries of `over`.
void Contraction::spread(Index point, Index over, Real entry) noexcept {
    Real all = 0;
    auto const for_each = [&](auto const& visit) {
        for (Offset f = rows.start[over]; f < rows.start[over + 1]; ++f) {
            Index const j = rows.column[f];
            if (rows.value[f] < 0 && (j == point || of_[j] == point)) visit(j, rows.value[f]);
        }
    };
    for_each([&](Index, Real share) { all += share; });
    for_each([&](Index j, Real share) {
        if (j != point) part_[j] += entry * (share / all);
    });
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
            for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e)
                if (!add(rows.column[e], weight * rows.value[e])) return false;
        }
        result.start[c] = begin;
        for (Offset e = begin; e < used; ++e) result.value[e] = row[e - begin];
    }
    result.start[n] = used;
    copy(result.diagonal, Span<const Real>(coarse_sum_.first(n)));
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
        Real flow = rows.row_sum[i] * sum_[i];
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e)
            flow += rows.value[e] * (sum_[rows.column[e]] - sum_[i]);
        for (Offset e = by.start[i]; e < by.start[i + 1]; ++e)
            coarse_sum_[by.column[e]] += by.weight[e] * flow;
    }
}

void Contraction::descend(CoarseRows const& result) noexcept {
    copy(rows.row_sum.first(result.n), Span<const Real>(coarse_sum_.first(result.n)));
    rows.take(result);
}

}  // namespace harmorph
