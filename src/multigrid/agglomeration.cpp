#include "multigrid/agglomeration.hpp"

#include "base/scalar.hpp"

namespace harmorph {
namespace {

// Couplings weaker than this fraction of the strongest one make no pair; 1/4 corresponds to an
// aspect ratio of 2. The cell whose strongest coupling is the smaller one decides: if couplings
// grow along a row of cells, each of them is the strongest coupling of one of its two cells.
constexpr Real strong = 0.25;

// The bound of the quality of a pair. The criterion and the size of the bound are those of A.
// Napov, Y. Notay, SIAM J. Sci. Comput. 34 (2012) A1079.
constexpr Real pair_quality_bound = 8;

// Returns a b / (a + b), two conductances in series, or 0 if one of them is not positive.
Real in_series(Real a, Real b) noexcept { return a > 0 && b > 0 ? a / (a + b) * b : 0; }

// The rules by which a cell prefers one neighbour to merge with.
struct Preference {
    using CellSums = Agglomeration::CellSums;
    SymmetricRows const& rows;
    Merging merging;

    Real coupling(Offset entry) const noexcept {
        if (rows.faces[entry] == 0) return 0;
        return merging == Merging::isotropic ? rows.faces[entry] : -rows.value[entry];
    }
    // A merged cell has one value, so the smoother must remove the difference between its two
    // members. The smoother does so only if the coupling of the two members, together with their
    // couplings to known values, is not small relative to their diagonals. A counterexample is two
    // stacks of thin cells that touch only weakly, each merged along strong couplings.
    bool is_smoothed(CellSums const& a, CellSums const& b, Real coupling) const noexcept {
        if (merging == Merging::isotropic) return true;
        return 2 * in_series(a.diagonal, b.diagonal) <=
               pair_quality_bound * (coupling + in_series(a.row_sum, b.row_sum));
    }
    bool is_strong(Real coupling, Real strongest) const noexcept {
        return coupling > 0 && (merging == Merging::isotropic || coupling >= strong * strongest);
    }
    // Among the strong couplings, the one with the largest weight is taken.
    Real weight(Offset entry, Real coupling) const noexcept {
        return merging == Merging::automatic ? rows.faces[entry] : coupling;
    }
};

}  // namespace

void Agglomeration::lay_out(Arena& arena, Index n) noexcept {
    Offset const cells = coarse_cells(n);
    pool_.n = 0;
    arena.take(pool_.diagonal, cells);
    arena.take(pool_.row_sum, cells);
    arena.take(pool_.start, cells + max_levels);
    arena.take(pool_.column, max_couplings * cells);
    arena.take(pool_.value, max_couplings * cells);
    arena.take(pool_.faces, max_couplings * cells);
    arena.take(cell_pool_, n + cells);
}

void Agglomeration::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    work_.rows.lay_out(arena, n, entries);
    arena.take(work_.first, n);
    arena.take(work_.second, n);
    arena.take(work_.sums, n);
    arena.take(work_.strongest, n);
    arena.take(work_.strongest_before, n);
    arena.take(work_.before, n);
    arena.take(work_.members, n);
    arena.take(work_.last, n);
}

void Agglomeration::build(SymmetricRows const& finest, MergingRules const& rules) noexcept {
    count = 1;
    level[0] = finest;
    cells_used_ = entries_used_ = maps_used_ = 0;
    Index const max_count = rules.max_levels == 0 ? max_levels : min(rules.max_levels, max_levels);
    while (count < max_count && level[count - 1].n > coarsest && add_level(rules.merging)) {}
}

bool Agglomeration::add_level(Merging merging) noexcept {
    SymmetricRows const& fine = level[count - 1];
    for (Index i = 0; i < fine.n; ++i) work_.sums[i] = {fine.diagonal[i], fine.row_sum[i]};
    Index const n_pairs = pair_up(fine, merging, work_.first);
    contract(fine, work_.first, n_pairs, work_.last, work_.rows);
    Index const n = pair_up(work_.rows, merging, work_.second);
    if (n > fine.n / min_reduction) return false;
    Span<Index> const map = cell_pool_.from(maps_used_, fine.n);
    for (Index i = 0; i < fine.n; ++i) map[i] = work_.second[work_.first[i]];

    SymmetricRows& merged = work_.rows;
    contract(fine, map, n, work_.last, merged);
    Offset const entries = merged.entries();
    if (entries > Offset{max_couplings} * n) return false;
    SymmetricRows& coarse = level[count];
    coarse.n = n;
    coarse.diagonal = pool_.diagonal.from(cells_used_, n);
    coarse.row_sum = pool_.row_sum.from(cells_used_, n);
    coarse.start = pool_.start.from(cells_used_ + count - 1, n + 1);
    coarse.column = pool_.column.from(entries_used_, entries);
    coarse.value = pool_.value.from(entries_used_, entries);
    coarse.faces = pool_.faces.from(entries_used_, entries);
    copy(coarse.diagonal, Span<const Real>(merged.diagonal.first(n)));
    copy(coarse.row_sum, Span<const Real>(merged.row_sum.first(n)));
    copy(coarse.start, Span<const Offset>(merged.start.first(n + 1)));
    copy(coarse.column, Span<const Index>(merged.column.first(entries)));
    copy(coarse.value, Span<const Real>(merged.value.first(entries)));
    copy(coarse.faces, Span<const std::uint8_t>(merged.faces.first(entries)));
    cell_of[count - 1] = map;
    cells_used_ += n;
    entries_used_ += entries;
    maps_used_ += fine.n;
    ++count;
    return true;
}

// Makes one pass: to [rows.n] receives the merged cell of each cell; returns the number of merged
// cells. Merged cells are numbered in the order of their first cells. The order therefore remains
// that of an advancing front, and the sums of merged cells may overwrite the sums of cells that are
// done.
Index Agglomeration::pair_up(SymmetricRows const& rows, Merging merging,
                             Span<Index> to) const noexcept {
    Work const& w = work_;
    Preference const prefers{rows, merging};
    fill(w.strongest.first(rows.n), 0.0);
    fill(w.strongest_before.first(rows.n), 0.0);
    rows.for_each([&](Index i, Index j, Offset e) {
        Real const coupling = prefers.coupling(e);
        w.strongest[i] = max(w.strongest[i], coupling);
        w.strongest[j] = max(w.strongest[j], coupling);
        if (!(coupling > w.strongest_before[j])) return;
        w.strongest_before[j] = coupling;
        w.before[j] = i;
    });
    fill(to.first(rows.n), none);
    Index n = 0;
    for (Index i = 0; i < rows.n; ++i) {
        if (to[i] != none) continue;
        Neighbours const found = find_neighbours(rows, merging, to, i);
        Index const partner = found.partner, host = found.host;
        CellSums merged = w.sums[i];
        if (partner != none) {
            merged += w.sums[partner];
            to[i] = to[partner] = n;
            w.members[n] = 2;
            w.sums[n++] = merged;
        } else if (host != none && w.members[to[host]] < max_members &&
                   prefers.is_smoothed(merged, w.sums[to[host]], found.host_coupling)) {
            to[i] = to[host];
            ++w.members[to[i]];
            w.sums[to[i]] += merged;
        } else {
            to[i] = n;
            w.members[n] = 1;
            w.sums[n++] = merged;
        }
    }
    return n;
}

Agglomeration::Neighbours Agglomeration::find_neighbours(SymmetricRows const& rows, Merging merging,
                                                         Span<const Index> to,
                                                         Index i) const noexcept {
    Work const& w = work_;
    Preference const prefers{rows, merging};
    Neighbours out;
    out.host = w.strongest_before[i] > 0 ? w.before[i] : none;
    out.host_coupling = w.strongest_before[i];
    Real best = 0, best_coupling = 0;
    for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
        Index const j = rows.column[e];
        Real const coupling = prefers.coupling(e);
        if (to[j] != none) {
            if (coupling > out.host_coupling) {
                out.host_coupling = coupling;
                out.host = j;
            }
            continue;
        }
        if (!prefers.is_strong(coupling, min(w.strongest[i], w.strongest[j]))) continue;
        if (!prefers.is_smoothed(w.sums[i], w.sums[j], coupling)) continue;
        Real const weight = prefers.weight(e, coupling);
        if (weight < best || (weight == best && !(coupling > best_coupling))) continue;
        best = weight;
        best_coupling = coupling;
        out.partner = j;
    }
    return out;
}

}  // namespace harmorph
