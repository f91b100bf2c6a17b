#include "multigrid/agglomeration.hpp"

#include "base/scalar.hpp"

namespace harmorph {
namespace {

// Couplings weaker than this fraction of the strongest one make no pair: 1/4 is an aspect ratio
// of 2. Of the two cells the one whose strongest coupling is smaller decides: where couplings grow
// along a row of cells, each of them is the strongest coupling of one of its two cells.
constexpr Real strong = 0.25;

// Bound of the quality of a pair; the criterion and the size of the bound are those of A. Napov, Y.
// Notay, SIAM J. Sci. Comput. 34 (2012) A1079.
constexpr Real pair_quality_bound = 8;

// a b / (a + b): two conductances in series; 0 if one is not positive.
Real in_series(Real a, Real b) noexcept { return a > 0 && b > 0 ? a / (a + b) * b : 0; }

// Which of its neighbours a cell is merged with.
struct Preference {
    using Part = Agglomeration::Part;
    SymmetricRows const& rows;
    Merging merging;

    Real coupling(Offset entry) const noexcept {
        if (rows.faces[entry] == 0) return 0;
        return merging == Merging::isotropic ? rows.faces[entry] : -rows.value[entry];
    }
    // A merged cell has one value, so the difference between its two parts must be removed by the
    // smoother. The smoother does so only if the coupling of the two, together with their couplings
    // to known values, is not small relative to their diagonals. A counterexample: two stacks of
    // thin cells, each merged along strong couplings, which touch only weakly.
    bool is_smoothed(Part const& a, Part const& b, Real coupling) const noexcept {
        if (merging == Merging::isotropic) return true;
        return 2 * in_series(a.diagonal, b.diagonal) <=
               pair_quality_bound * (coupling + in_series(a.row_sum, b.row_sum));
    }
    bool is_strong(Real coupling, Real strongest) const noexcept {
        return coupling > 0 && (merging == Merging::isotropic || coupling >= strong * strongest);
    }
    // Among strong couplings the one with the largest weight is taken.
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
    arena.take(pool_.start, cells + most_levels);
    arena.take(pool_.column, most_couplings * cells);
    arena.take(pool_.value, most_couplings * cells);
    arena.take(pool_.faces, most_couplings * cells);
    arena.take(cell_pool_, n + cells);
}

void Agglomeration::lay_out_work(Arena& arena, Index n, Offset entries) noexcept {
    work_.rows.lay_out(arena, n, entries);
    arena.take(work_.first, n);
    arena.take(work_.second, n);
    arena.take(work_.parts, n);
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
    Index const most = rules.max_levels == 0 ? most_levels : min(rules.max_levels, most_levels);
    while (count < most && level[count - 1].n > coarsest && add_level(rules.merging)) {}
}

bool Agglomeration::add_level(Merging merging) noexcept {
    SymmetricRows const& fine = level[count - 1];
    for (Index i = 0; i < fine.n; ++i) work_.parts[i] = {fine.diagonal[i], fine.row_sum[i]};
    Index const n_pairs = pair_up(fine, merging, work_.first);
    contract(fine, work_.first, n_pairs, work_.last, work_.rows);
    Index const n = pair_up(work_.rows, merging, work_.second);
    if (n > fine.n / least_reduction) return false;
    Span<Index> const map = cell_pool_.from(maps_used_, fine.n);
    for (Index i = 0; i < fine.n; ++i) map[i] = work_.second[work_.first[i]];

    SymmetricRows& merged = work_.rows;
    contract(fine, map, n, work_.last, merged);
    Offset const entries = merged.entries();
    if (entries > Offset{most_couplings} * n) return false;
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

// One pass: to [rows.n] receives the merged cell of each cell; returns the number of merged cells.
// They are numbered in the order of their first cells: so the order stays that of an advancing
// front, and the parts of merged cells may overwrite the parts of cells that are done.
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
        Index partner = none, host = w.strongest_before[i] > 0 ? w.before[i] : none;
        Real best = 0, best_coupling = 0, strongest_host = w.strongest_before[i];
        for (Offset e = rows.start[i]; e < rows.start[i + 1]; ++e) {
            Index const j = rows.column[e];
            Real const coupling = prefers.coupling(e);
            if (to[j] != none) {
                if (coupling > strongest_host) {
                    strongest_host = coupling;
                    host = j;
                }
                continue;
            }
            if (!prefers.is_strong(coupling, min(w.strongest[i], w.strongest[j]))) continue;
            if (!prefers.is_smoothed(w.parts[i], w.parts[j], coupling)) continue;
            Real const weight = prefers.weight(e, coupling);
            if (weight < best || (weight == best && !(coupling > best_coupling))) continue;
            best = weight;
            best_coupling = coupling;
            partner = j;
        }
        Part merged = w.parts[i];
        if (partner != none) {
            merged += w.parts[partner];
            to[i] = to[partner] = n;
            w.members[n] = 2;
            w.parts[n++] = merged;
        } else if (host != none && w.members[to[host]] < most_members &&
                   prefers.is_smoothed(merged, w.parts[to[host]], strongest_host)) {
            to[i] = to[host];
            ++w.members[to[i]];
            w.parts[to[i]] += merged;
        } else {
            to[i] = n;
            w.members[n] = 1;
            w.parts[n++] = merged;
        }
    }
    return n;
}

}  // namespace harmorph
